#include "engine/optim/trial_vector.hpp"

#include "engine/optim/crossover.hpp"
#include "engine/optim/mutation.hpp"

namespace torquescope {

void make_rand_1_bin_trial(MatrixView<double const> const& members, std::size_t target, TrialSettings const& settings,
                           Bounds const& bounds, RandomStream& random, std::span<double> trial) {
  auto const picked = pick_three_others(random, members.rows(), target);
  mutate_rand_1(members, picked, settings.F, trial);
  cross_binomial(random, settings.CR, members.row(target), trial);
  repair_bounds(settings.repair, bounds, members.row(target), random, trial);
}

}  // namespace torquescope
