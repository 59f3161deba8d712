#pragma once
// Loads behind a gap, side by side in vector registers: of one shape for replicates, of one shape each for columns.
//
// Why        a load takes thousands of sub-steps in a second, most of them without contact made or lost: those are the
//            same few operations in every lane. Loads of other shapes may take more of them than their neighbours,
//            which wait
// Bits       those of one load alone (load_behind_gap.hpp) on every instruction set
// Threads    the memory is used by one thread

#include <memory>

#include "engine/effects/load_behind_gap.hpp"
#include "engine/effects/memory_effect.hpp"

namespace torquescope::load_behind_gap {

std::unique_ptr<EffectMemory> loads_behind_gap(LoadBehindGap const& fresh, std::size_t lanes);

}  // namespace torquescope::load_behind_gap
