#pragma once
// The elements and attributes of MJCF that say something of an arm; the rest of a model is left alone.
//
// Source     MuJoCo documentation, XML reference (3.3)

#include <span>

#include "engine/robot/xml_words.hpp"

namespace torquescope {

std::span<XmlWords const> mjcf_words();

}  // namespace torquescope
