#pragma once
// Loads behind a gap, one per twin, side by side in vector registers.
//
// Why        a twin with backlash takes thousands of sub-steps in a second, most of them without contact made or lost: those are the
//            same few operations in every lane
// Bits       those of one load alone (load_behind_gap.hpp) on every instruction set
// Threads    the memory is used by one thread

#include <memory>

#include "engine/effects/load_behind_gap.hpp"
#include "engine/effects/memory_effect.hpp"

namespace torquescope::load_behind_gap {

std::unique_ptr<EffectMemory> loads_behind_gap(LoadBehindGap const& fresh, std::size_t lanes);

}  // namespace torquescope::load_behind_gap
