#include "engine/experiment/runs/rollout_stage.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "engine/simulate/rollout/rollout_residuals.hpp"
#include "engine/store/scale_datasets.hpp"

namespace torquescope {

namespace {

constexpr std::size_t of_position = 0, of_torque = 1;

// of the channel that a table shows
std::vector<PredictionMetrics> metrics_on(RolloutParts const& rollout, RolloutData const& data,
                                          std::vector<Eigen::VectorXd> const& parameters, int threads) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<PredictionMetrics> all;
  RolloutTask task{data.tracks, {}, channels_of(rollout.plan.loop)};
  for (auto const& values : parameters) {
    task.structures.clear();
    std::vector<std::vector<RolloutTrial>> trials;
    for (auto const& track : data.tracks) {
      task.structures.push_back(rollout.model->structure_for(values, track.tick_s()));
      trials.push_back({rollout.model->trial(values)});
    }
    auto const residuals = residuals_of(task, trials, threads);
    std::size_t const channel = residuals.front().samples[of_torque].size() > 0 ? of_torque : of_position;
    double n = 0.0, sum = 0.0, squares = 0.0, energy = 0.0;
    for (std::size_t t = 0; t < residuals.size(); ++t) {
      auto const& left = residuals[t].samples[channel];
      Eigen::VectorXd const signal = channel == of_torque ? data.tracks[t].torque : untold_positions(data.tracks[t]);
      n += static_cast<double>(left.size());
      sum += left.sum();
      squares += left.squaredNorm();
      for (auto const& segment : data.tracks[t].segments)
        energy += signal.segment(segment.first, segment.samples).squaredNorm();
    }
    double const average = sum / n, mse = squares / n;
    if (!std::isfinite(mse)) {
      all.push_back({none, none, none, none, none});
      continue;
    }
    all.push_back(
        {mse, squares, std::sqrt(squares / energy), average, std::sqrt(std::max(0.0, mse - average * average))});
  }
  return all;
}

bool judges_torque(RolloutParts const& rollout) {
  return channels_of(rollout.plan.loop)[of_torque] && rollout.train.tracks.front().drive == TrackDrive::reference;
}

}  // namespace

RolloutFit fit_by_rollouts(Experiment::Parts const& parts, LmOptions const& options, int threads,
                           StopAsked const& stop) {
  RolloutParts const& rollout = *parts.rollout;
  return fit_rollouts(*rollout.model, rollout.train.tracks, channels_of(rollout.plan.loop), options, threads,
                      static_cast<std::uint64_t>(parts.experiment.seed), stop);
}

void measure_rollouts(Experiment::Parts const& parts, int threads, RunResults& results) {
  RolloutParts const& rollout = *parts.rollout;
  results.train = metrics_on(rollout, rollout.train, results.parameters, threads);
  if (!rollout.validate.tracks.empty())
    results.validate = metrics_on(rollout, rollout.validate, results.parameters, threads);
}

void write_rollout_fit(ResultWriter& writer, std::string const& label, RolloutFit const& fit) {
  std::string const group = "/runs/" + label;
  auto const n = static_cast<std::size_t>(fit.parameters.size());
  writer.numbers(group + "/standard_error", {1, n}, {fit.errors.data(), n},
                 Note{"SI", "standard error", "Newey-West"}.over({"run", "parameter"}));
  std::vector<double> intervals;
  for (Eigen::Index k = 0; k < fit.parameters.size(); ++k)
    intervals.insert(intervals.end(), {fit.lower[k], fit.upper[k]});
  writer.numbers(group + "/ci95", {1, n, 2}, intervals,
                 Note{"SI", "95 % interval"}.over({"run", "parameter", "bound"}));
  write_bounds(writer, group);
  writer.attribute(group, "sums_of_squares", std::vector<double>(fit.sums.begin(), fit.sums.end()));
  writer.attribute(group, "effective_samples", std::vector<double>(fit.effective.begin(), fit.effective.end()));
  writer.attribute(group, "at_bounds", fit.at_bounds);
}

std::string rollout_error_unit(Experiment::Parts const& parts) {
  bool const slides = parts.regressor->joint() == JointKind::prismatic;
  return judges_torque(*parts.rollout) ? parts.torque_unit() : (slides ? "m" : "rad");
}

void write_rollout_errors(ResultWriter& writer, std::string const& label, Experiment::Parts const& parts) {
  bool const of_force = judges_torque(*parts.rollout), slides = parts.regressor->joint() == JointKind::prismatic;
  bool const has_loop = parts.rollout->train.tracks.front().drive == TrackDrive::reference;
  char const* const how = has_loop ? "in closed loop" : "from the recorded torque";
  writer.attribute("/runs/" + label, "rollout_error_unit", rollout_error_unit(parts));
  writer.attribute("/runs/" + label, "remark",
                   fmt::format("errors are of the {} on all samples, simulated {}; of rows they would be others",
                               of_force ? (slides ? "force" : "torque") : "position", how));
}

}  // namespace torquescope
