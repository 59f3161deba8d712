#pragma once
// One DE/rand/1/bin trial vector: mutation, binomial crossover, bound repair.
//
// Random     all draws from the member's own stream, in this order: three members, j_rand, one per parameter, repairs
// Promise    inside the box

#include <cstddef>
#include <span>

#include "engine/base/matrix_view.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/optim/bound_repair.hpp"

namespace torquescope {

struct TrialSettings {
  double F = 0.5;
  double CR = 0.9;
  BoundRepair repair = BoundRepair::midpoint;
};

void make_rand_1_bin_trial(MatrixView<double const> const& members, std::size_t target, TrialSettings const& settings,
                           Bounds const& bounds, RandomStream& random, std::span<double> trial);

}  // namespace torquescope
