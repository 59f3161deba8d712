#pragma once
// Contacts that age while they stand and are renewed as they slide, side by side in vector registers: of one shape for
// replicates, of one shape each for columns. effects/breakaway_dwell.cpp has the equation.
//
// Why        a replicate takes 50 000 steps per second, and each needs two exponentials and a logarithm: of one number
//            after the other by the system's library they were half of a diagnosis that names this effect
// Bits       those of one contact alone on every instruction set and machine (kernels/elementary.hpp)
// Threads    the memory is used by one thread

#include <memory>

#include "engine/effects/memory_effect.hpp"

namespace torquescope {

struct AgeingContact {
  double dwell_s = 1.0, renewal_distance = 1.0, rest_speed = 1.0;  // s; rad, m; rad/s, m/s
  FrictionSign sign{};
};

// two columns: friction that grows to an end, and with the logarithm of the rest
std::unique_ptr<EffectMemory> ageing_contacts(AgeingContact const& contact, std::size_t lanes);

}  // namespace torquescope
