#include "engine/fit/optim/trial_vector.hpp"

#include <algorithm>
#include <array>

#include "engine/fit/optim/crossover.hpp"
#include "engine/fit/optim/mutation.hpp"
#include "kernels/rand_1_bin.hpp"

namespace torquescope {

namespace {

// three members, j_rand, one per parameter: repairs draw behind them
std::size_t draws_of_trial(std::size_t dimension) { return 4 + dimension; }

// of those that left the box, flagged 1
void repair_trials(MatrixView<double const> const& members, std::size_t first_member,
                   std::span<std::uint8_t const> outside, BoundRepair repair, Bounds const& bounds,
                   TrialStreams const& streams, MatrixView<double> const& trials) {
  for (std::size_t i = 0; i < outside.size(); ++i) {
    if (outside[i] == 0) continue;
    std::size_t const member = first_member + i;
    RandomStream random(streams.key, streams.generation, static_cast<std::uint32_t>(member));
    if (repair == BoundRepair::random) random.skip(draws_of_trial(trials.columns()));
    repair_bounds(repair, bounds, members.row(member), random, trials.row(member));
  }
}

}  // namespace

void make_rand_1_bin_trial(MatrixView<double const> const& members, std::size_t target, TrialSettings const& settings,
                           Bounds const& bounds, RandomStream& random, std::span<double> trial) {
  auto const picked = pick_three_others(random, members.rows(), target);
  mutate_rand_1(members, picked, settings.F, trial);
  cross_binomial(random, settings.CR, members.row(target), trial);
  repair_bounds(settings.repair, bounds, members.row(target), random, trial);
}

void make_rand_1_bin_trials(MatrixView<double const> const& members, TrialSettings const& settings,
                            Bounds const& bounds, TrialStreams const& streams, MatrixView<double> const& trials) {
  TORQUESCOPE_EXPECT(trials.rows() == members.rows() && trials.columns() == members.columns());
  kernels::Rand1Bin const population{members.rows(),      members.columns(), members.data(), bounds.lower.data(),
                                     bounds.upper.data(), settings.F,        settings.CR};
  auto const key = RandomStream::philox_key(streams.key);
  auto const counter = RandomStream::first_counter(streams.key, streams.generation, 0);
  kernels::PhiloxStreams const philox{{key[0], key[1]}, counter[1], counter[2], counter[3]};
  // whole groups of the kernel's lanes, flagged on the stack
  std::array<std::uint8_t, 64> outside;
  for (std::size_t first = 0; first < members.rows(); first += outside.size()) {
    std::size_t const count = std::min(outside.size(), members.rows() - first);
    kernels::rand_1_bin_trials(population, philox, {first, count}, trials.data(), outside.data());
    repair_trials(members, first, std::span(outside).first(count), settings.repair, bounds, streams, trials);
  }
}

}  // namespace torquescope
