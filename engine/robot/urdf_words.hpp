#pragma once
// The elements and attributes of a URDF that say something of an arm; what others may add is left alone.
//
// Source     http://wiki.ros.org/urdf/XML and its pages; urdfdom 3.0

#include <span>

#include "engine/robot/xml_words.hpp"

namespace torquescope {

std::span<XmlWords const> urdf_words();

}  // namespace torquescope
