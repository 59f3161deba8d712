#pragma once
// Standard (distal) Denavit-Hartenberg numbers to the modified ones of SerialChain: the same arm, frames elsewhere.
//
// Equation   standard T(i-1, i) = Rz(theta_i) Tz(d_i) Tx(a_i) Rx(alpha_i). Regrouped, a_i and alpha_i are those of the
//            next joint in modified form; the last ones are the flange
// Source     Lipkin 2005, doi:10.1115/DETC2005-85460

#include "engine/robot/serial_chain.hpp"

namespace torquescope {

// a and alpha of `chain` are standard ones, and links, where there are any, are about the standard frames
SerialChain from_standard_dh(SerialChain chain);

}  // namespace torquescope
