#include "engine/rollout/rollout_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/dense_solvers.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/problem/hac.hpp"
#include "engine/rollout/effective_samples.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
constexpr double infinite = std::numeric_limits<double>::infinity();

// where the search stands: parameters of the model, then position and speed of every segment beside the measured ones
struct Point {
  Eigen::VectorXd parameters, starts;
};

class Search {
 public:
  Search(RolloutModel const& model, std::vector<RolloutTrack> const& tracks, CountedChannels counts,
         LmOptions const& options, int threads, StopAsked const& stop)
      : model_(model), tracks_(tracks), options_(options), threads_(threads), stop_(stop), task_{tracks, {}, counts} {
    for (auto const& track : tracks) {
      task_.structures.push_back(model.structure_for(model.start(), track.tick_s()));
      bool const frees = options.fits_starts && track.drive == TrackDrive::reference && track.segments.size() == 1;
      first_start_.push_back(n_starts_);
      has_starts_.push_back(frees);
      if (frees) n_starts_ += 2;
    }
    width_ = options.width;
  }

  RolloutFit run(Eigen::VectorXd const& start) {
    Point at{start, Eigen::VectorXd::Zero(n_starts_)};
    effective_.fill(1.0);
    RolloutFit fit;
    double best = infinite;
    for (std::int64_t pass = 0; pass < options_.passes; ++pass) {
      weigh(at);
      best = objective(sums_at({at}).front());
      if (!std::isfinite(best)) break;
      width_ = options_.width;
      for (std::int64_t i = 0; i < options_.iterations; ++i) {
        if (stop_ && stop_()) break;
        ++fit.iterations;
        if (!improve(at, best)) break;
      }
    }
    fit.failed = !std::isfinite(best);
    fit.parameters = at.parameters;
    fit.sums = sums_at({at}).front();
    fit.effective = effective_;
    fit.objective = fit.failed ? infinite : best;
    fit.at_bounds = bounds_reached(at.parameters);
    set_intervals(at, fit);
    fit.evaluations = evaluations_;
    return fit;
  }

  double log_sums(Eigen::VectorXd const& parameters) {
    return objective(sums_at({Point{parameters, Eigen::VectorXd::Zero(n_starts_)}}).front());
  }

 private:
  std::vector<RolloutTrial> trials_on(std::size_t track, std::vector<Point> const& points) const {
    std::vector<RolloutTrial> trials;
    for (auto const& point : points) {
      trials.push_back(model_.trial(point.parameters));
      if (!has_starts_[track]) continue;
      trials.back().position_step = point.starts[first_start_[track]];
      trials.back().velocity_step = point.starts[first_start_[track] + 1];
    }
    return trials;
  }

  std::vector<TrackResiduals> residuals_at(std::vector<Point> const& points) {
    evaluations_ += static_cast<std::int64_t>(points.size());
    std::vector<std::vector<RolloutTrial>> trials;
    for (std::size_t track = 0; track < tracks_.size(); ++track) trials.push_back(trials_on(track, points));
    return residuals_of(task_, trials, threads_);
  }

  std::vector<ChannelNumbers> sums_at(std::vector<Point> const& points) {
    auto const residuals = residuals_at(points);
    std::vector<ChannelNumbers> sums(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t channel = 0; channel < n_channels; ++channel) {
        double sum = 0.0;
        for (auto const& track : residuals)
          if (track.samples[channel].size() > 0) sum += track.samples[channel].col(static_cast<Index>(i)).squaredNorm();
        sums[i][channel] = std::isfinite(sum) ? sum : infinite;
      }
    return sums;
  }

  double objective(ChannelNumbers const& sums) const {
    double value = 0.0;
    for (std::size_t channel = 0; channel < n_channels; ++channel) {
      if (sums[channel] == 0.0) continue;  // does not count, or is met exactly
      value += effective_[channel] * std::log(sums[channel]);
    }
    return std::isfinite(value) ? value : infinite;
  }

  // independent squares of what is left here
  void weigh(Point const& at) {
    auto const residuals = residuals_at({at});
    effective_.fill(0.0);
    for (std::size_t t = 0; t < tracks_.size(); ++t)
      for (std::size_t channel = 0; channel < n_channels; ++channel) {
        auto const& samples = residuals[t].samples[channel];
        if (samples.size() == 0 || !samples.allFinite()) continue;
        Index first = 0;
        for (auto const& segment : tracks_[t].segments) {
          effective_[channel] += effective_samples(samples.col(0).segment(first, segment.samples));
          first += segment.samples;
        }
      }
  }

  Index unknowns() const { return static_cast<Index>(model_.size()) + n_starts_; }

  double scale_of(Index k) const {
    auto const n = static_cast<Index>(model_.size());
    if (k < n) return model_.parameters()[static_cast<std::size_t>(k)].scale;
    // of a start: an encoder step, and that a sample
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      if (!has_starts_[t] || k - n - first_start_[t] > 1) continue;
      auto const measured = tracks_[t].position.array();
      double const range = measured.maxCoeff() - measured.minCoeff();
      double const length = std::max(tracks_[t].encoder_step, 1e-3 * range);
      constexpr double hundred_of_width = 100.0;
      return hundred_of_width * (k - n == first_start_[t] ? length : length * 10.0);
    }
    return 1.0;
  }

  static double& coordinate(Point& point, Index k) {
    return k < point.parameters.size() ? point.parameters[k] : point.starts[k - point.parameters.size()];
  }

  double clipped(Index k, double value) const {
    auto const n = static_cast<Index>(model_.size());
    if (k >= n) return value;
    auto const& one = model_.parameters()[static_cast<std::size_t>(k)];
    return std::clamp(value, one.lower, one.upper);
  }

  // normal equations, every channel by its own noise
  struct Slope {
    Eigen::MatrixXd curvature;
    Eigen::VectorXd descent;
    std::vector<Eigen::MatrixXd> jacobian;  // of each track and channel that counts: d simulated, weighed
    std::vector<Eigen::VectorXd> residual;  // weighed
  };

  Slope slope_at(Point const& at) {
    Index const p = unknowns();
    std::vector<Point> points{at};
    Eigen::VectorXd steps(p);
    for (Index k = 0; k < p; ++k) {
      double const h = width_ * local_scale(at, k);
      Point more = at, less = at;
      coordinate(more, k) = clipped(k, coordinate(more, k) + h);
      coordinate(less, k) = clipped(k, coordinate(less, k) - h);
      steps[k] = coordinate(more, k) - coordinate(less, k);
      points.push_back(std::move(more));
      points.push_back(std::move(less));
    }
    auto const residuals = residuals_at(points);
    ChannelNumbers const sums = sums_of(residuals);
    Slope slope{Eigen::MatrixXd::Zero(p, p), Eigen::VectorXd::Zero(p), {}, {}};
    for (auto const& track : residuals)
      for (std::size_t channel = 0; channel < n_channels; ++channel) {
        auto const& samples = track.samples[channel];
        if (samples.size() == 0 || sums[channel] == 0.0) continue;
        double const weight = std::sqrt(effective_[channel] / sums[channel]);
        Eigen::MatrixXd jacobian(samples.rows(), p);
        for (Index k = 0; k < p; ++k) {
          if (steps[k] > 0.0) jacobian.col(k) = (samples.col(2 + 2 * k) - samples.col(1 + 2 * k)) * (weight / steps[k]);
          if (!(steps[k] > 0.0) || !jacobian.col(k).allFinite()) jacobian.col(k).setZero();
        }
        Eigen::VectorXd residual = weight * samples.col(0);
        slope.curvature += jacobian.transpose() * jacobian;
        slope.descent += jacobian.transpose() * residual;
        slope.jacobian.push_back(std::move(jacobian));
        slope.residual.push_back(std::move(residual));
      }
    return slope;
  }

  double local_scale(Point const& at, Index k) const {
    double const scale = scale_of(k);
    if (k >= static_cast<Index>(model_.size())) return scale;
    auto const& one = model_.parameters()[static_cast<std::size_t>(k)];
    double const here = std::abs(at.parameters[k]);
    // a small inertia, gain or speed is changed by a share of itself: a step over its end is no derivative
    return one.is_logarithmic || (one.lower == 0.0 && here > 0.0) ? std::min(scale, std::max(here, 1e-3 * scale))
                                                                  : scale;
  }

  static ChannelNumbers sums_of(std::vector<TrackResiduals> const& residuals) {
    ChannelNumbers sums{};
    for (auto const& track : residuals)
      for (std::size_t channel = 0; channel < n_channels; ++channel)
        if (track.samples[channel].size() > 0) sums[channel] += track.samples[channel].col(0).squaredNorm();
    return sums;
  }

  // sixteen dampings from hardly any to a creep
  std::vector<Point> steps_from(Point const& at, Slope const& slope) const {
    constexpr int dampings = static_cast<int>(twin_lanes);
    std::vector<Point> points;
    Index const p = unknowns();
    Eigen::VectorXd diagonal(p);
    for (Index k = 0; k < p; ++k) diagonal[k] = std::max(slope.curvature(k, k), 1e-12);
    for (int i = 0; i < dampings; ++i) {
      double const damping = std::pow(10.0, -6.0 + 0.6 * i);
      Eigen::MatrixXd damped = slope.curvature;
      damped.diagonal() += damping * diagonal;
      Eigen::VectorXd const step = solve_semidefinite(damped, slope.descent);
      Point to = at;
      for (Index k = 0; k < p; ++k)
        if (std::isfinite(step[k])) coordinate(to, k) = clipped(k, coordinate(to, k) + step[k]);
      points.push_back(std::move(to));
    }
    return points;
  }

  // false: it has come to rest
  bool improve(Point& at, double& best) {
    // in units of the statistic, whose noise is a few: a tenth decides nothing
    constexpr double least_gain = 0.1, wider = 4.0, widest = 40.0;
    while (width_ <= widest * options_.width) {
      auto const candidates = steps_from(at, slope_at(at));
      auto const sums = sums_at(candidates);
      std::size_t first = 0;
      for (std::size_t i = 1; i < sums.size(); ++i)
        if (objective(sums[i]) < objective(sums[first])) first = i;
      double const gain = best - objective(sums[first]);
      if (gain > 0.0) {
        at = candidates[first];
        best -= gain;
      }
      if (gain > least_gain) return true;
      width_ *= wider;
    }
    return false;
  }

  std::vector<std::string> bounds_reached(Eigen::VectorXd const& parameters) const {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < model_.size(); ++k) {
      auto const& one = model_.parameters()[k];
      double const value = parameters[static_cast<Index>(k)];
      if (value <= one.lower || value >= one.upper) names.push_back(one.name);
    }
    return names;
  }

  void set_intervals(Point const& at, RolloutFit& fit) {
    auto const n = static_cast<Index>(model_.size());
    fit.errors = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
    fit.lower = fit.upper = fit.errors;
    if (fit.failed) return;
    width_ = options_.width;
    Slope const slope = slope_at(at);
    // what is at a bound, or moves nothing, has no interval
    std::vector<Index> free;
    for (Index k = 0; k < unknowns(); ++k) {
      bool const is_bound = k < n && (at.parameters[k] <= model_.parameters()[static_cast<std::size_t>(k)].lower ||
                                      at.parameters[k] >= model_.parameters()[static_cast<std::size_t>(k)].upper);
      if (!is_bound && slope.curvature(k, k) > 0.0) free.push_back(k);
    }
    if (free.empty()) return;
    Index rows = 0;
    std::vector<Index> first_row{0};
    for (auto const& one : slope.residual) first_row.push_back(rows += one.size());
    Eigen::MatrixXd phi(rows, static_cast<Index>(free.size()));
    Eigen::VectorXd psi(rows);
    for (std::size_t part = 0; part < slope.residual.size(); ++part) {
      psi.segment(first_row[part], slope.residual[part].size()) = slope.residual[part];
      for (std::size_t k = 0; k < free.size(); ++k)
        phi.col(static_cast<Index>(k)).segment(first_row[part], slope.residual[part].size()) =
            slope.jacobian[part].col(free[k]);
    }
    // columns of one size: an inertia beside a weight
    Eigen::VectorXd const size = phi.colwise().norm().transpose() / std::sqrt(static_cast<double>(rows));
    phi.array().rowwise() /= size.transpose().array();
    Eigen::MatrixXd const gram = phi.transpose() * phi;
    Eigen::MatrixXd const bread =
        solve_semidefinite(gram, Eigen::MatrixXd(Eigen::MatrixXd::Identity(gram.rows(), gram.cols())));
    RowScores const scores{phi, psi, first_row};
    std::int64_t const lags = andrews_lags(scores);
    Eigen::MatrixXd const covariance = newey_west_covariance(scores, bread, lags);
    double const critical = critical_value(lags, rows);
    for (std::size_t k = 0; k < free.size(); ++k) {
      if (free[k] >= n) continue;
      auto const i = static_cast<Index>(k);
      double const error = std::sqrt(covariance(i, i)) / size[i];
      fit.errors[free[k]] = error;
      fit.lower[free[k]] = at.parameters[free[k]] - critical * error;
      fit.upper[free[k]] = at.parameters[free[k]] + critical * error;
    }
  }

  RolloutModel const& model_;
  std::vector<RolloutTrack> const& tracks_;
  LmOptions const& options_;
  int threads_;
  StopAsked const& stop_;
  RolloutTask task_;
  std::vector<Index> first_start_;
  std::vector<bool> has_starts_;
  Index n_starts_ = 0;
  ChannelNumbers effective_{};
  double width_ = 0.0;
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
  auto const starts = starts_of(model, options, seed);
  // of several starts each is followed a little way, and the best to its end
  LmOptions tried = options;
  constexpr std::int64_t a_little = 8;
  if (starts.size() > 1) tried.iterations = std::min(options.iterations, a_little);
  if (starts.size() > 1) tried.passes = 1;
  auto const follow = [&](Eigen::VectorXd const& start, LmOptions const& how) {
    RolloutFit fit = Search(model, tracks, counts, how, threads, stop).run(start);
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
  return best;
}

}  // namespace torquescope
