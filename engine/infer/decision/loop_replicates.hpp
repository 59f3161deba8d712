#pragma once
// Replicates of a model in its loop: what it would leave of recordings that it made itself.
//
// Each       is simulated from the reference with the encoder's steps in the loop, its steps elsewhere, and noise with
//            the spectrum of what the recording leaves beyond such replicates (row_noise.hpp)
// Shapes     of each channel that counts: [samples of all tracks][replicates], replicate less the model without noise
// Random     addressed by (seed, step, replicate, track, channel)
// Threads    spreads replicates over `threads`; same bits for any number
// Source     parametric bootstrap: Davison, Hinkley 1997, doi:10.1017/CBO9780511802843

#include <cstdint>

#include "engine/infer/decision/loop_tangent.hpp"

namespace torquescope {

struct LoopReplicates {
  std::size_t count = 32;
  std::uint64_t seed = 0;
  std::uint32_t step = 0;
  int threads = 1;
};

// those that ran away are left out
ChannelRows loop_replicates(FitUnknowns const& unknowns, FitPoint const& at, LoopReplicates const& how);

}  // namespace torquescope
