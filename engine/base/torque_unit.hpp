#pragma once
// Units of a model whose torque is known up to a factor only: in amperes a torque of "N m" is one of "A".
//
// Rule       the unit of force or torque at the front is replaced: "N m s/rad" becomes "mA s/rad", "kg m2" becomes
//            "mA s2/rad", "kg" becomes "mA s2/m"; a unit without one stays as it is
// Threads    pure function

#include <string>

namespace torquescope {

// si: of a parameter or signal, as effects have it. torque: the recorded column's; "", "N m" and "N" leave si as it is
std::string in_torque_unit(std::string const& si, std::string const& torque);

}  // namespace torquescope
