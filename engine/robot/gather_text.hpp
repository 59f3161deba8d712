#pragma once
// What a base parameter is made of, as a line for people.

#include <string>

#include "engine/robot/base_parameters.hpp"

namespace torquescope {

// of "xxr2": "xx2 - yy2 - 0.0929 (m3 + m4 + m5)"; of one that gathers nothing its name
std::string gather_text(BaseParameters const& base, Eigen::Index parameter);

}  // namespace torquescope
