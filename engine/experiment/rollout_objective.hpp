#pragma once
// The fitness of a search by rollouts: squares of all samples of every channel that counts, each channel by its own
// noise.
//
// Equation   fitness = mean over channels of S_c / (n_c v_c), v_c: mean square that the start leaves (RolloutParts); 1
//            at the start, inf where a rollout diverges
// Shapes     candidates: members x parameters of the model, row-major
// Bits       of a member: the same whatever stands beside it
// Threads    const object, shared

#include <Eigen/Core>

#include "engine/experiment/rollout_parts.hpp"
#include "engine/fit/optim/objective.hpp"
#include "engine/simulate/rollout/rollout_residuals.hpp"

namespace torquescope {

class RolloutObjective final : public Objective {
 public:
  // rollout outlives this
  RolloutObjective(RolloutParts const& rollout, Bounds bounds);

  Bounds const& bounds() const override { return bounds_; }
  void evaluate(MatrixView<double const> candidates, std::span<double> fitness, Workspace& workspace) const override;
  double fitness_of(Eigen::VectorXd const& parameters) const;

 private:
  RolloutParts const& rollout_;
  Bounds bounds_;
  RolloutTask task_;
  ChannelNumbers weights_{};  // 1 / (n_c v_c) over the number of channels
};

}  // namespace torquescope
