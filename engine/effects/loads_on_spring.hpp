#pragma once
// Loads on springs that may stiffen, side by side in vector registers: of one shape for replicates, of one each for
// columns. effects/joint_elasticity.cpp has the equation.
//
// Memory     y and y' of each: of a straight spring exact for an acceleration that runs straight between two samples;
//            what stiffens is a kick before and after each step
// Why        a sample takes some thirty operations, each of which waits for the one before: eight loads wait together
// Bits       the same on every instruction set and in every lane
// Threads    the memory is used by one thread
// Source     kicks: Strang 1968

#include <cstddef>
#include <memory>

#include "engine/effects/memory_effect.hpp"

namespace torquescope::load_on_spring {

struct Spring {
  double frequency_hz = 0.0, damping = 0.0, hardening = 0.0;
  double acceleration = 0.0;  // whose wind-up hardening is counted in; 0: the spring is straight
};

std::unique_ptr<EffectMemory> loads_on_spring(Spring const& spring, std::size_t lanes);

}  // namespace torquescope::load_on_spring
