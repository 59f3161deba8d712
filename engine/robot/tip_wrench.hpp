#pragma once
// What a wrench at the tip of an arm gives to its joints.
//
// Equation   tau = J(q)' w, J of the tip's origin: M ddq + ... = tau_motor + tau
// Shapes     q: n x N; wrench: n x 6, force then moment about the tip's origin; result: n x N
// Frames     tip: axes of SerialChain::flange; base: those of the robot file's base frame
// Units      rad or m; N and N m; N m, or N of a slide
// Threads    pure function
// Source     Khalil and Dombre 2002, section 5.9

#include <Eigen/Core>

#include "engine/robot/serial_chain.hpp"

namespace torquescope {

enum class WrenchFrame { tip, base };

Eigen::MatrixXd torques_of_wrench(SerialChain const& chain, Eigen::Ref<Eigen::MatrixXd const> const& q,
                                  Eigen::Ref<Eigen::MatrixXd const> const& wrench, WrenchFrame frame);

}  // namespace torquescope
