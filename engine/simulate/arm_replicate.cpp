#include "engine/simulate/arm_replicate.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

using Eigen::Index;

// one joint's controller, and what it remembers
class LoopRunner {
 public:
  LoopRunner(ArmJointLoop const& loop, double rate_hz)
      : loop_(loop), reference_(loop.reference), open_(open_part(loop.controller, loop.reference)) {
    if (loop.fed_forward.size() > 0) open_ += loop.fed_forward;
    // before the start the joint came along at its first velocity
    for (std::size_t lag = 0; lag < loop.controller.position.size(); ++lag)
      seen_.push_back(loop.start_position - static_cast<double>(lag + 1) * loop.start_velocity / rate_hz);
  }

  double command(Index k, double position) {
    auto const& controller = loop_.controller;
    std::rotate(seen_.begin(), seen_.end() - 1, seen_.end());
    seen_.front() = position;
    summed_error_ += reference_(k + controller.shift) - position;
    double torque = open_[k] + controller.integral * summed_error_;
    for (std::size_t lag = 0; lag < seen_.size(); ++lag) torque += controller.position[lag] * seen_[lag];
    return std::clamp(torque, controller.least, controller.most);
  }

  bool has_run_away(Index k, double position) const {
    return !(std::abs(position - loop_.reference[k]) <= loop_.farthest);
  }

 private:
  ArmJointLoop const& loop_;
  ReferenceSignal reference_;
  Eigen::VectorXd open_;
  std::vector<double> seen_;  // the newest first
  double summed_error_ = 0.0;
};

}  // namespace

std::optional<Eigen::MatrixXd> replicate_arm(ArmPlant plant, std::vector<ArmJointLoop> const& loops, double rate_hz,
                                             double step_s) {
  TORQUESCOPE_EXPECT(static_cast<Index>(loops.size()) == plant.size() && rate_hz > 0.0 && step_s > 0.0);
  Index const n = loops.front().reference.size(), joints = plant.size();
  auto const steps = static_cast<int>(std::ceil(1.0 / (rate_hz * step_s) * (1.0 - 1e-9)));
  double const tick_s = 1.0 / rate_hz;
  std::vector<LoopRunner> runners;
  ArmState state{0.0, Eigen::VectorXd(joints), Eigen::VectorXd(joints)};
  for (Index j = 0; j < joints; ++j) {
    auto const& loop = loops[static_cast<std::size_t>(j)];
    TORQUESCOPE_EXPECT(loop.reference.size() == n && !loop.controller.position.empty());
    runners.emplace_back(loop, rate_hz);
    state.q[j] = loop.start_position;
    state.dq[j] = loop.start_velocity;
  }
  Eigen::MatrixXd positions(n, joints);
  Eigen::VectorXd torque(joints);
  for (Index k = 0; k < n; ++k) {
    for (Index j = 0; j < joints; ++j) {
      auto& runner = runners[static_cast<std::size_t>(j)];
      if (runner.has_run_away(k, state.q[j])) return {};
      torque[j] = runner.command(k, state.q[j]);
    }
    positions.row(k) = state.q.transpose();
    state.time_s = static_cast<double>(k) * tick_s;
    for (int step = 0; step < steps; ++step) plant.advance(state, torque, tick_s / steps);
  }
  return positions;
}

}  // namespace torquescope
