#pragma once
// The equation of motion of replicate_lanes.hpp with dry friction that does not hold at once: it bends before it
// slides, and it creeps.
//
// Equation   dry = middle + half s, D ds/dt = dq - v s, -1 <= s <= 1; middle, half: of [backward, forward]
//              D = 0: friction grows straight with the speed up to v; v = 0: straight with the way, up to D; both 0:
//              set-valued. Takes energy at any D, v >= 0
// Steps      s implicit in the velocity at the end (any step is stable), first order where it changes; sliding is that
//            of replicate_lanes.hpp
// Shapes     as replicate_lanes.hpp. Units: v in rad/s or m/s; D in rad or m
// Bits       the same on every instruction set
// Source     Dupont, Hayward, Armstrong, Altpeter 2002, doi:10.1109/TAC.2002.1000274; steps: Acary, Brogliato 2008,
//            doi:10.1007/978-3-540-75392-6

#include <cstddef>

#include "engine/simulate/replicate_lanes.hpp"

namespace torquescope {

struct LaneSticking {
  alignas(64) double creep[replicate_lanes] = {};   // v
  alignas(64) double length[replicate_lanes] = {};  // D
  alignas(64) double bend[replicate_lanes] = {};    // s; carried from step to step
};

// `steps` steps of step_s each
void advance_sticking_lanes(LaneJoints const& joints, LaneTorques const& torques, double step_s, std::size_t steps,
                            LaneSticking& sticking, LaneState& state);

}  // namespace torquescope
