#pragma once
// The inertia of a body in MJCF: what <inertial> says, or that of its geoms.
//
// Equation   solid spheres, capsules, cylinders, boxes and ellipsoids of a density, or of the mass that is written
// Errors     Error 78: an inertia that is none, a geom without a size, with the place
// Source     MuJoCo documentation, XML reference: inertial, geom, compiler/inertiafromgeom

#include <optional>
#include <string>

#include "engine/robot/mjcf_document.hpp"

namespace torquescope {

struct MjcfInertia {
  std::optional<LinkInertia> body{};  // in the body's frame; nothing: no mass
  std::string unknown{};              // why nobody can tell, as a sentence with file and line
};

// class_around: of the bodies around, for defaults of geoms
MjcfInertia mjcf_inertia(MjcfDocument const& document, XmlElement const& body, std::string const& class_around);

}  // namespace torquescope
