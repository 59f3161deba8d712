#include "engine/fit/problem/fitness_choice.hpp"

#include <fmt/format.h>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

// Evaluations of a direct search that take as long as two sweeps. Measured on AVX-512 with 30 members (scripts/bench):
// 52, 60, 106, 206 for 4, 11, 24, 60 parameters. A coarse rule does: a search of one run evaluates thousands of times.
std::int64_t repaid_after(Eigen::Index n_parameters) { return 40 + 3 * static_cast<std::int64_t>(n_parameters); }

FitnessChoice every_sample(ObjectiveOptions const& options, std::string const& why) {
  return {false, false, fmt::format("every sample ({}): {}", options.fitness, why)};
}

}  // namespace

bool wants_statistics(ObjectiveOptions const& options, Eigen::Index n_parameters, std::int64_t evaluations) {
  if (options.precision == "float32") return true;  // they tell what noise the rounding hides in
  if (options.fitness == "direct" || options.fitness == "rollout" || options.loss != "squares") return false;
  return options.fitness == "gram" || evaluations >= repaid_after(n_parameters);
}

FitnessChoice choose_fitness(ObjectiveOptions const& options, Eigen::Index n_parameters, std::int64_t evaluations,
                             SufficientStatistics const* statistics) {
  if (options.fitness == "direct") return every_sample(options, "as the job says");
  if (options.fitness == "rollout")
    return {false, false, "rollouts: every sample of the recordings, simulated in their loops", true};
  if (options.loss != "squares") return every_sample(options, options.loss + " is no sum of squares");
  if (!wants_statistics(options, n_parameters, evaluations))
    return every_sample(options, fmt::format("{} evaluations do not repay statistics, {} would", evaluations,
                                             repaid_after(n_parameters)));
  TORQUESCOPE_EXPECT(statistics != nullptr);
  if (!statistics->usable()) return every_sample(options, "statistics would not be exact, " + statistics->refusal());
  return {true, false,
          fmt::format("sufficient statistics ({}): least error {:.1e} of the torque's mean square, condition {:.2g}, "
                      "{} evaluations",
                      options.fitness, statistics->noise_share(), statistics->condition(), evaluations)};
}

FitnessChoice single_precision_choice(ObjectiveOptions const& options, SinglePrecisionCheck const& check) {
  TORQUESCOPE_EXPECT(check.usable());
  return {false, true,
          fmt::format("every sample ({}) in float32: its MSE is within {:.0e} of float64's around least squares, which "
                      "leaves {:.1e} of the torque",
                      options.fitness, check.error, check.noise)};
}

}  // namespace torquescope
