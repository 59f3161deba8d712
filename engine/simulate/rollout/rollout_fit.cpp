#include "engine/simulate/rollout/rollout_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/base/dense_solvers.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/simulate/rollout/effective_samples.hpp"
#include "engine/simulate/rollout/fit_slope.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
constexpr double infinite = std::numeric_limits<double>::infinity();

// from one start to where the sum of both channels comes to rest
class Search {
 public:
  Search(FitUnknowns const& unknowns, LmOptions const& options, int threads, StopAsked const& stop)
      : unknowns_(unknowns), options_(options), threads_(threads), stop_(stop), width_(options.width) {}

  RolloutFit run(FitPoint at) {
    RolloutFit fit;
    double best = infinite;
    for (std::int64_t pass = 0; pass < options_.passes; ++pass) {
      best = weighed(at);
      if (!std::isfinite(best)) break;
      width_ = options_.width;
      for (std::int64_t i = 0; i < options_.iterations; ++i) {
        if (stop_ && stop_()) break;
        ++fit.iterations;
        fit.is_at_rest = !improve(at, best, !options_.widens || pass + 1 < options_.passes);
        if (fit.is_at_rest) break;
      }
    }
    fit.failed = !std::isfinite(best);
    fit.parameters = at.parameters;
    fit.starts = at.starts;
    fit.sums = sums_;
    fit.effective = effective_;
    fit.objective = fit.failed ? infinite : best;
    for (Index k = 0; k < unknowns_.parameters(); ++k)
      if (unknowns_.is_at_bound(at, k))
        fit.at_bounds.push_back(unknowns_.model().parameters()[static_cast<std::size_t>(k)].name);
    FitIntervals const none = no_intervals(unknowns_.parameters());
    fit.errors = none.errors;
    fit.lower = none.lower;
    fit.upper = none.upper;
    fit.evaluations = evaluations_;
    return fit;
  }

 private:
  std::vector<TrackResiduals> residuals_at(std::vector<FitPoint> const& points) {
    evaluations_ += static_cast<std::int64_t>(points.size());
    return unknowns_.residuals_at(points, threads_);
  }

  FitSlope slope(FitPoint const& at, double width) {
    evaluations_ += 1 + 2 * unknowns_.size();
    return slope_at(unknowns_, at, effective_, width, threads_);
  }

  std::vector<ChannelNumbers> sums_at(std::vector<FitPoint> const& points) {
    auto const residuals = residuals_at(points);
    std::vector<ChannelNumbers> sums;
    for (std::size_t i = 0; i < points.size(); ++i) sums.push_back(sums_of(residuals, static_cast<Index>(i)));
    return sums;
  }

  double objective(ChannelNumbers const& sums) const {
    double value = 0.0;
    for (std::size_t channel = 0; channel < n_channels; ++channel)
      // nothing is left of a channel that does not count, or is met exactly
      if (sums[channel] != 0.0) value += effective_[channel] * std::log(sums[channel]);
    return std::isfinite(value) ? value : infinite;
  }

  // the objective here, after the independent squares of what is left have been counted anew
  double weighed(FitPoint const& at) {
    auto const residuals = residuals_at({at});
    sums_ = sums_of(residuals, 0);
    effective_.fill(0.0);
    for (std::size_t t = 0; t < residuals.size(); ++t)
      for (std::size_t channel = 0; channel < n_channels; ++channel) {
        auto const& samples = residuals[t].samples[channel];
        if (samples.size() == 0 || !samples.allFinite()) continue;
        Index first = 0;
        for (auto const& segment : unknowns_.tracks()[t].segments) {
          effective_[channel] += effective_samples(samples.col(0).segment(first, segment.samples));
          first += segment.samples;
        }
      }
    return objective(sums_);
  }

  // sixteen dampings from hardly any to a creep
  std::vector<FitPoint> steps_from(FitPoint const& at, FitSlope const& slope) const {
    constexpr int dampings = static_cast<int>(replicate_lanes);
    constexpr double least_curvature = 1e-12, decades = 0.6, first_decade = -6.0;
    Eigen::VectorXd const diagonal = slope.curvature.diagonal().cwiseMax(least_curvature);
    std::vector<FitPoint> points;
    for (int i = 0; i < dampings; ++i) {
      Eigen::MatrixXd damped = slope.curvature;
      damped.diagonal() += std::pow(10.0, first_decade + decades * i) * diagonal;
      Eigen::VectorXd const step = solve_semidefinite(damped, slope.descent);
      FitPoint to = at;
      for (Index k = 0; k < step.size(); ++k)
        if (std::isfinite(step[k])) to[k] = unknowns_.clipped(k, to[k] + step[k]);
      points.push_back(std::move(to));
    }
    return points;
  }

  double least_gain() const {
    double const squares = std::accumulate(effective_.begin(), effective_.end(), 0.0);
    return std::max(options_.least_gain, options_.least_share * squares);
  }

  // what a whole step would gain if the model were its plane, without bounds
  static double promised(FitSlope const& slope) {
    return slope.descent.dot(solve_semidefinite(slope.curvature, slope.descent));
  }

  // false: it has come to rest
  bool improve(FitPoint& at, double& best, bool is_rough) {
    constexpr double wider = 4.0, widest = 40.0;
    double const last = is_rough ? options_.width : widest * options_.width;
    while (width_ <= last) {
      FitSlope const here = slope(at, width_);
      if (promised(here) < least_gain()) return false;
      auto const candidates = steps_from(at, here);
      auto const sums = sums_at(candidates);
      std::size_t first = 0;
      for (std::size_t i = 1; i < sums.size(); ++i)
        if (objective(sums[i]) < objective(sums[first])) first = i;
      double const gain = best - objective(sums[first]);
      if (gain > 0.0) {
        at = candidates[first];
        sums_ = sums[first];
        best -= gain;
      }
      if (gain > least_gain()) return true;
      width_ *= wider;
    }
    return false;
  }

  FitUnknowns const& unknowns_;
  LmOptions const& options_;
  int threads_;
  StopAsked const& stop_;
  ChannelNumbers effective_{}, sums_{};  // of the best point
  double width_;
  std::int64_t evaluations_ = 0;
};

// the model's own start, and others whose free shapes are drawn from their ranges
std::vector<Eigen::VectorXd> starts_of(RolloutModel const& model, LmOptions const& options, std::uint64_t seed) {
  std::vector<Eigen::VectorXd> starts{model.start()};
  auto const& parameters = model.parameters();
  auto const is_open = [](RolloutParameter const& one) { return one.is_shape && !one.is_given; };
  if (std::none_of(parameters.begin(), parameters.end(), is_open)) return starts;
  for (std::int64_t i = 1; i < options.starts; ++i) {
    RandomStream random({seed, 0, RandomDomain::optimiser}, 0, static_cast<std::uint32_t>(i));
    starts.push_back(model.start());
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      auto const& one = parameters[k];
      double const share = random.uniform();
      if (!is_open(one)) continue;
      starts.back()[static_cast<Index>(k)] = one.is_logarithmic ? one.lower * std::pow(one.upper / one.lower, share)
                                                                : one.lower + share * (one.upper - one.lower);
    }
  }
  return starts;
}

RolloutFit intervals_known(RolloutFit fit, FitUnknowns const& unknowns, double width, int threads) {
  if (fit.failed) return fit;
  FitPoint const at{fit.parameters, fit.starts};
  FitSlope const slope = slope_at(unknowns, at, fit.effective, width, threads);
  fit.evaluations += 1 + 2 * unknowns.size();
  FitIntervals intervals = intervals_of(unknowns, at, slope);
  fit.errors = std::move(intervals.errors);
  fit.lower = std::move(intervals.lower);
  fit.upper = std::move(intervals.upper);
  return fit;
}

}  // namespace

OptionTable<LmOptions> const& LmOptions::table() {
  static OptionTable<LmOptions> const table(
      "estimator", "Levenberg-Marquardt on rollouts, from least squares",
      {{"iterations", &LmOptions::iterations, "1", 1, 1e4, "at most, of each pass"},
       {"passes", &LmOptions::passes, "1", 1, 10, "each with the channels weighed by what the one before leaves"},
       {"width", &LmOptions::width, "1", 1e-6, 0.1, "of the differences, as a share of a parameter's scale"},
       {"starts", &LmOptions::starts, "1", 1, 1000,
        "searches from shapes of effects drawn from their range, where the job does not give them"},
       {"fits_starts", &LmOptions::fits_starts, "position and speed at each start are parameters beside the others"}});
  return table;
}

RolloutFit fit_rollouts(RolloutModel const& model, std::vector<RolloutTrack> const& tracks, CountedChannels counts,
                        LmOptions const& options, int threads, std::uint64_t seed, StopAsked const& stop) {
  RolloutFit best;
  std::int64_t evaluations = 0, iterations = 0;
  bool is_first = true;
  auto const log_energy = [](RolloutFit const& fit) {
    double value = 0.0;
    for (double const sum : fit.sums)
      if (sum > 0.0) value += std::log(sum);
    return fit.failed ? infinite : value;
  };
  FitUnknowns const unknowns(model, tracks, counts, options.fits_starts);
  auto const starts = starts_of(model, options, seed);
  // of several starts each is followed a little way, and the best to its end
  LmOptions tried = options;
  constexpr std::int64_t a_little = 8;
  if (starts.size() > 1) tried.iterations = std::min(options.iterations, a_little);
  if (starts.size() > 1) tried.passes = 1;
  auto const follow = [&](Eigen::VectorXd const& start, LmOptions const& how) {
    RolloutFit fit = Search(unknowns, how, threads, stop).run(unknowns.begin_at(start));
    evaluations += fit.evaluations;
    iterations += fit.iterations;
    // fits of different weights compare by what they leave, both channels alike
    if (is_first || log_energy(fit) <= log_energy(best)) best = std::move(fit);
    is_first = false;
  };
  for (auto const& start : starts) follow(start, tried);
  if (starts.size() > 1) follow(Eigen::VectorXd(best.parameters), options);
  best.evaluations = evaluations;
  best.iterations = iterations;
  return intervals_known(std::move(best), unknowns, options.width, threads);
}

RolloutFit fit_rollouts_from(RolloutModel const& model, std::vector<RolloutTrack> const& tracks, CountedChannels counts,
                             Eigen::VectorXd const& starts, LmOptions const& options, int threads) {
  FitUnknowns const unknowns(model, tracks, counts, options.fits_starts);
  FitPoint at = unknowns.begin_at(model.start());
  if (starts.size() == at.starts.size()) at.starts = starts;
  return Search(unknowns, options, threads, {}).run(std::move(at));
}

RolloutFit with_intervals(RolloutFit fit, RolloutModel const& model, std::vector<RolloutTrack> const& tracks,
                          CountedChannels counts, LmOptions const& options, int threads) {
  FitUnknowns const unknowns(model, tracks, counts, options.fits_starts);
  return intervals_known(std::move(fit), unknowns, options.width, threads);
}

}  // namespace torquescope
