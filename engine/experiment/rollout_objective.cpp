#include "engine/experiment/rollout_objective.hpp"

#include <limits>
#include <utility>

namespace torquescope {

RolloutObjective::RolloutObjective(RolloutParts const& rollout, Bounds bounds)
    : rollout_(rollout), bounds_(std::move(bounds)), task_{rollout.train.tracks, {}, channels_of(rollout.plan.loop)} {
  RolloutModel const& model = *rollout.model;
  for (auto const& track : task_.tracks) task_.structures.push_back(model.structure_for(model.start(), track.tick_s()));
  double counted = 0.0;
  for (std::size_t channel = 0; channel < n_channels; ++channel) {
    double n = 0.0;
    for (std::size_t t = 0; t < task_.tracks.size(); ++t)
      if (task_.count(t, channel)) n += static_cast<double>(task_.tracks[t].samples());
    if (n == 0.0 || !(rollout.variance[channel] > 0.0)) continue;
    weights_[channel] = 1.0 / (n * rollout.variance[channel]);
    counted += 1.0;
  }
  for (double& weight : weights_) weight /= counted > 0.0 ? counted : 1.0;
}

void RolloutObjective::evaluate(MatrixView<double const> candidates, std::span<double> fitness, Workspace&) const {
  std::vector<RolloutTrial> trials;
  for (std::size_t i = 0; i < candidates.rows(); ++i)
    trials.push_back(rollout_.model->trial(
        Eigen::Map<Eigen::VectorXd const>(candidates.row(i).data(), static_cast<Eigen::Index>(candidates.columns()))));
  auto const sums = sums_of_squares(task_, trials, 1);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    fitness[i] = 0.0;
    for (std::size_t channel = 0; channel < n_channels; ++channel)
      if (weights_[channel] > 0.0) fitness[i] += weights_[channel] * sums[i][channel];
    if (!trials[i].is_possible) fitness[i] = std::numeric_limits<double>::infinity();
  }
}

double RolloutObjective::fitness_of(Eigen::VectorXd const& parameters) const {
  double fitness = 0.0;
  Workspace workspace;
  evaluate({parameters.data(), 1, static_cast<std::size_t>(parameters.size())}, {&fitness, 1}, workspace);
  return fitness;
}

}  // namespace torquescope
