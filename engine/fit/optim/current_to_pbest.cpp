#include "engine/fit/optim/current_to_pbest.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/fit/optim/crossover.hpp"
#include "engine/fit/optim/mutation.hpp"

namespace torquescope {

std::size_t share_of_members(double share, std::size_t n_members) {
  return static_cast<std::size_t>(std::lround(share * static_cast<double>(n_members)));
}

void make_current_to_pbest_trials(PBestTrials const& of, DrawControls const& draw, TrialStreams const& streams,
                                  MatrixView<double> const& trials) {
  auto const& members = of.members;
  auto const& archive = of.archive;
  auto const order = ranking(of.fitness);
  auto const n_best = static_cast<std::uint32_t>(
      std::clamp(share_of_members(of.best_share, members.rows()), std::size_t{2}, members.rows()));
  TORQUESCOPE_EXPECT(of.first + trials.rows() <= members.rows());
  for (std::size_t row = 0; row < trials.rows(); ++row) {
    std::size_t const i = of.first + row;
    RandomStream random(streams.key, streams.generation, static_cast<std::uint32_t>(i));
    auto const [F, CR] = draw(i, random);
    auto const best = members.row(order[random.below(n_best)]);
    std::size_t const r1 = pick_another<1>(random, members.rows(), {i});
    std::size_t const r2 = pick_another<2>(random, members.rows() + archive.size(), {smaller(i, r1), larger(i, r1)});
    auto const minus = r2 < members.rows() ? members.row(r2) : archive.row(r2 - members.rows());
    auto const trial = trials.row(row);
    mutate_current_to_best_1(members.row(i), best, members.row(r1), minus, F, trial);
    cross_binomial(random, CR, members.row(i), trial);
    repair_bounds(of.repair, of.bounds, members.row(i), random, trial);
  }
}

double improvement(double before, double after) {
  double const fall = 0.5 * before - 0.5 * after;
  return std::isfinite(fall) ? std::max(fall, 0.0) : 0.0;
}

double improvement_of(Selected const& step, std::size_t member) {
  return improvement(step.before.fitness[member], step.after.fitness[member]);
}

}  // namespace torquescope
