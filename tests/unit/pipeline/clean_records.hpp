#pragma once
// Recordings of joints that lack nothing, made by engine/simulate's scalar plant and its own controllers.

#include <cmath>
#include <numbers>
#include <string>

#include "engine/infer/pipeline/record_pipeline.hpp"
#include "engine/simulate/joint_simulation.hpp"
#include "unit/simulate/plants.hpp"

namespace torquescope::test {

inline constexpr double counts_per_revolution = 400000.0;

struct CleanJoint {
  SimulationPlan plan;
  Eigen::VectorXd truth;  // inertia, viscous, coulomb, offset
};

inline Regressor const& clean_regressor() {
  static Regressor const regressor({"inertia", "viscous", "coulomb", "offset"}, JointKind::revolute);
  return regressor;
}

// torques of the order of 1 N m, noise of 1 % of them
inline CleanJoint clean_joint(double inertia = 0.036, double viscous = 0.164, double coulomb = 1.3,
                              double offset = -0.125) {
  CleanJoint joint;
  joint.truth = Eigen::Vector4d(inertia, viscous, coulomb, offset);
  auto& plan = joint.plan;
  plan.simulation.rate_hz = 1000.0;
  plan.simulation.duration_s = 8.0;
  plan.simulation.step_s = 1e-4;
  plan.plant = plant({{"inertia", inertia}, {"viscous", viscous}, {"coulomb", coulomb}, {"offset", offset}});
  plan.reference.amplitude = 1.5;
  plan.controller.kind = "pd";
  plan.controller.bandwidth_hz = 8.0;
  plan.controller.velocity_cutoff_hz = 0.0;
  plan.encoder.counts_per_revolution = counts_per_revolution;
  plan.noise.torque_std = 0.015 * coulomb;
  return joint;
}

inline FilterOptions clean_filter() {
  FilterOptions filter;
  filter.cutoff_hz = 80.0;
  filter.parallel_cutoff_hz = 30.0;
  filter.decimate_to_hz = 200.0;
  return filter;
}

// only what a logger writes
inline Recording recorded(SimulatedRecording const& simulated) {
  Recording recording;
  recording.name = simulated.name;
  recording.rate_hz = simulated.rate_hz;
  recording.time_s = simulated.time_s;
  recording.position = simulated.position;
  recording.torque = simulated.torque;
  recording.reference = simulated.reference;
  recording.rows.encoder_step = 2.0 * std::numbers::pi / counts_per_revolution;
  return recording;
}

inline RecordPipeline clean_pipeline(Recording const& recording) {
  return {clean_regressor(), clean_filter(), recording.rate_hz, recording.position.size()};
}

}  // namespace torquescope::test
