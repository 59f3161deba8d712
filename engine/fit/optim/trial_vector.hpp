#pragma once
// DE/rand/1/bin trial vectors: mutation, binomial crossover, bound repair.
//
// Random     all draws from the member's own stream, in this order: three members, j_rand, one per parameter, repairs
// Promise    inside the box; a population's trials at once are bit for bit those of its members one by one
// Shapes     members, trials: members x dimension, apart
// Speed      37 ns per trial of four parameters one by one, random numbers computed ahead; 13 all at once (AVX-512)

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/base/matrix_view.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/fit/optim/bound_repair.hpp"

namespace torquescope {

struct TrialSettings {
  double F = 0.5;
  double CR = 0.9;
  BoundRepair repair = BoundRepair::midpoint;
};

// of one member: what a trial is
void make_rand_1_bin_trial(MatrixView<double const> const& members, std::size_t target, TrialSettings const& settings,
                           Bounds const& bounds, RandomStream& random, std::span<double> trial);

// the streams of a population's trials: (key, generation, member)
struct TrialStreams {
  RandomKey key;
  std::uint32_t generation = 0;
};

// of every member
void make_rand_1_bin_trials(MatrixView<double const> const& members, TrialSettings const& settings,
                            Bounds const& bounds, TrialStreams const& streams, MatrixView<double> const& trials);

}  // namespace torquescope
