#include "engine/infer/pipeline/simulator_gap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/infer/pipeline/held_torque.hpp"
#include "engine/infer/pipeline/reversal_mask.hpp"

namespace torquescope {
namespace {

// straight from the last sample before each stretch that is not `known` to the first one after it
void bridge(Eigen::VectorXd& values, std::vector<bool> const& known) {
  auto const first = std::find(known.begin(), known.end(), true) - known.begin();
  if (first == values.size()) {
    values.setZero();
    return;
  }
  values.head(first).setConstant(values[first]);
  Eigen::Index before = first;
  for (Eigen::Index k = first; k < values.size(); ++k) {
    if (!known[static_cast<std::size_t>(k)]) continue;
    double const slope = (values[k] - values[before]) / static_cast<double>(std::max<Eigen::Index>(1, k - before));
    for (Eigen::Index i = before + 1; i < k; ++i) values[i] = values[before] + slope * static_cast<double>(i - before);
    before = k;
  }
  values.tail(values.size() - 1 - before).setConstant(values[before]);
}

// torque of the simulator that its terms do not give, at the full rate; no row sees the samples that are bridged
Eigen::VectorXd beyond_terms(Recording const& recording, Motion const& motion, Regressor const& regressor,
                             Eigen::VectorXd const& parameters) {
  return bridged_over_rests(recording.simulated_torque - regressor.columns(motion) * parameters, motion.dq,
                            recording.rate_hz);
}

Recording less(Eigen::VectorXd beyond, Recording recording) {
  recording.simulated_torque.resize(0);
  recording.torque -= torque_to_hold(beyond);
  recording.gear_load = std::move(beyond);
  return recording;
}

}  // namespace

Eigen::VectorXd bridged_over_rests(Eigen::VectorXd torque, Eigen::VectorXd const& dq, double rate_hz) {
  constexpr double no_margin = 0.0;
  bridge(torque, moving_samples(dq, rate_hz, no_margin));
  return torque;
}

SimulatorGap gap_to_simulator(Recording const& recording, RecordPipeline const& pipeline) {
  TORQUESCOPE_EXPECT(recording.simulated_torque.size() == recording.torque.size());

  // the simulator seen through the terms of the model, on the same rows as the joint itself. It says what the motion of
  // a row needs, where the joint's torque is held
  Recording simulated = recording;
  simulated.torque = torque_to_hold(recording.simulated_torque);
  ProcessedRecord const of_simulator = pipeline.process(simulated);
  ProcessedRecord const of_joint = pipeline.process(recording);

  SimulatorGap gap;
  gap.simulator_parameters = of_simulator.parameters;
  gap.parameter_errors = of_simulator.parameters - of_joint.parameters;
  gap.beyond_rms = std::sqrt(of_simulator.residual.squaredNorm() / static_cast<double>(of_simulator.residual.size()));
  double const difference = (of_joint.torque - of_simulator.torque).squaredNorm();
  double const left = (of_joint.residual - of_simulator.residual).squaredNorm();
  gap.parameter_share = difference > 0.0 ? 1.0 - left / difference : 0.0;

  gap.recording = less(
      beyond_terms(recording, of_simulator.motion, pipeline.model().regressor(), of_simulator.parameters), recording);
  return gap;
}

Recording without_simulator(Recording recording, RecordPipeline const& pipeline,
                            Eigen::VectorXd const& simulator_parameters) {
  if (recording.simulated_torque.size() == 0) return recording;
  TORQUESCOPE_EXPECT(recording.simulated_torque.size() == recording.torque.size());
  Motion const motion = pipeline.prepare(recording).motion;
  Eigen::VectorXd beyond = beyond_terms(recording, motion, pipeline.model().regressor(), simulator_parameters);
  return less(std::move(beyond), std::move(recording));
}

}  // namespace torquescope
