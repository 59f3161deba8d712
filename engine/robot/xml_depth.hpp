#pragma once
// Bounds the nesting of an XML text before its parser, which recurses, sees it.
//
// Errors     Error 65 with the place where it is too deep

#include "engine/robot/robot_text.hpp"

namespace torquescope {

void refuse_deep_xml(RobotText const& text);

}  // namespace torquescope
