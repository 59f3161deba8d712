#pragma once
// Levenberg-Marquardt on rollouts: parameters of a joint and its loop that bring simulation and recording together, on
// every sample of every channel.
//
// Objective  sum over channels of n_eff ln S, S: the sum of squares over all tracks; n_eff of the residual where the
//            fit stands, set anew once it has come to rest (effective_samples.hpp). Equal to least squares with each
//            channel by its own noise
// Jacobian   central differences of `width` of a parameter's scale, all trials side by side. In the last pass they are
//            four times wider where no step gains what the slope promises: dry friction makes the sum rough
// Step       sixteen dampings at once, the best of them; parameters stay within their bounds
// Nuisances  what each recording has of its own (fit_unknowns.hpp): its start, its offset
// Intervals  95 %, Newey-West on the scores of all samples (problem/hac.hpp), the nuisances beside them
// Failed     a fit that ends above its start, or never finds a finite sum: `failed`, with the start's numbers
// Units      SI
// Threads    spreads trials over threads; same bits for any number of them
// Source     Levenberg 1944; Marquardt 1963, doi:10.1137/0111030; Nash, Walker-Smith 1987 (weights by the residual)

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/simulate/rollout/rollout_model.hpp"
#include "engine/simulate/rollout/rollout_residuals.hpp"

namespace torquescope {

struct LmOptions {
  std::int64_t iterations = 40;  // of each pass
  std::int64_t passes = 2;
  double width = 2e-3;
  std::int64_t starts = 4;  // of shapes whose start the job does not give
  bool fits_starts = true;  // nuisances of segments; never of windows
  // of the statistic, whose noise is a few: an iteration that gains less ends the search; no key of a job
  double least_gain = 0.1;
  double least_share = 0.0;  // the same as a share of n_eff, a fall of ln S; no key of a job
  bool widens = true;        // differences in the last pass; no key of a job

  static OptionTable<LmOptions> const& table();
};

struct RolloutFit {
  Eigen::VectorXd parameters, errors;  // errors: standard, NaN where not known
  Eigen::VectorXd starts;              // nuisances of the tracks (fit_unknowns.hpp)
  Eigen::VectorXd lower, upper;        // 95 %
  ChannelNumbers sums{}, effective{};  // of squares, over all samples; independent ones
  double objective = 0.0;
  std::vector<std::string> at_bounds{};
  std::int64_t evaluations = 0, iterations = 0;
  bool is_at_rest = false;  // no step of the last iteration gained what is asked
  bool failed = false;
};

// asked between two iterations; true: the best so far is returned
using StopAsked = std::function<bool()>;

RolloutFit fit_rollouts(RolloutModel const& model, std::vector<RolloutTrack> const& tracks, CountedChannels counts,
                        LmOptions const& options, int threads, std::uint64_t seed, StopAsked const& stop = {});

// from one point, the nuisances with it: [0] where they begin at zero. Without intervals
RolloutFit fit_rollouts_from(RolloutModel const& model, std::vector<RolloutTrack> const& tracks, CountedChannels counts,
                             Eigen::VectorXd const& starts, LmOptions const& options, int threads);
// the fit with its intervals; of a model that begins where the fit came to rest
RolloutFit with_intervals(RolloutFit fit, RolloutModel const& model, std::vector<RolloutTrack> const& tracks,
                          CountedChannels counts, LmOptions const& options, int threads);

}  // namespace torquescope
