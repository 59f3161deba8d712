#pragma once
// How the dry friction of a joint passes through rest: nobody's recording tells it, and every rig has another.
//
// at_once    anything up to the level at rest, the level while sliding (Coulomb)
// creep      grows straight with the speed up to `speed`
// bristle    level z / D + s_1 dz/dt, dz/dt = v - |v| z / D, D = length, s_1: a tenth of critical damping (LuGre)
// band       below `speed` the joint rests as long as what pushes it is below the level (Karnopp)
// Units      rad/s or m/s; rad or m
// Errors     sticking_named: std::invalid_argument for an unknown name
// Source     Karnopp 1985, doi:10.1115/1.3140698; Canudas de Wit, Olsson, Astrom, Lischinsky 1995,
//            doi:10.1109/9.376053

#include <string>
#include <vector>

namespace concealed {

enum class Sticking { at_once, creep, bristle, band };

struct StickingLaw {
  Sticking kind = Sticking::at_once;
  double speed = 0.0, length = 0.0;
  // an equation without events: friction follows from speed and state
  bool is_smooth() const { return kind == Sticking::creep || kind == Sticking::bristle; }
};

// coulomb, creep_0.2, creep_2, creep_20 (mrad/s or mm/s), lugre, karnopp; encoder_step: lugre's length
StickingLaw sticking_named(std::string const& name, double encoder_step);
std::vector<std::string> const& sticking_names();

}  // namespace concealed
