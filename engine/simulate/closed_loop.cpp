#include "engine/simulate/closed_loop.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/simulate/joint_loop.hpp"

namespace torquescope {

namespace {

// the joint's state is finite and somewhere near where it should be
void validate_loop(SimulationPlan const& plan, JointState const& state, ReferencePoint const& wanted) {
  double const distance = std::abs(state.q - wanted.q);
  validate(distance <= 100.0 * plan.reference.amplitude, [&] {
    Problem problem;
    problem.what =
        fmt::format("the simulated loop is unstable: at {:.4g} s the joint is {:.3g} away from its reference",
                    state.time_s, distance);
    problem.key = "simulate.controller";
    problem.help = "lower the gains, bandwidth_hz or delay_ticks, or raise the controller's rate_hz";
    return problem;
  });
}

}  // namespace

void record_sample(SimulatedRecording& recording, Eigen::Index i, JointState const& state, ReferencePoint const& wanted,
                   double measured_position, double logged_torque, double acting_torque) {
  recording.time_s[i] = state.time_s;
  recording.reference[i] = wanted.q;
  recording.position[i] = measured_position;
  recording.torque[i] = logged_torque;
  recording.true_position[i] = state.q;
  recording.true_velocity[i] = state.dq;
  recording.true_acceleration[i] = state.ddq;
  recording.true_torque[i] = acting_torque;
}

void record_closed_loop(SimulationPlan const& plan, Reference const& reference, RandomKey const& key,
                        SimulatedRecording& recording) {
  // sizes
  Eigen::Index const samples = plan.simulation.samples();
  double const rate_hz = controller_rate_hz(plan.controller, plan.simulation.rate_hz);
  Eigen::Index const ticks_per_sample = std::llround(rate_hz / plan.simulation.rate_hz);
  double const substeps = std::ceil(1.0 / (rate_hz * plan.simulation.step_s) * (1.0 - 1e-9));
  double const step_s = 1.0 / (rate_hz * substeps);
  for (auto* channel :
       {&recording.time_s, &recording.reference, &recording.position, &recording.torque, &recording.true_position,
        &recording.true_velocity, &recording.true_acceleration, &recording.true_torque})
    channel->resize(samples);

  // the loop's parts
  JointPlant const plant(plan.plant);
  ReferencePoint const start = reference.at(0.0);
  JointState state{0.0, start.q, start.dq, 0.0};
  double const inertia = plant.inertia(state);
  JointLoop loop({plan.controller, plan.encoder, plan.noise, rate_hz, recording.rate_hz}, key, inertia, start);
  recording.gains = loop.gains();
  recording.controller_rate_hz = rate_hz;

  for (Eigen::Index tick = 0; tick < samples * ticks_per_sample; ++tick) {
    // measure and answer
    state.time_s = static_cast<double>(tick) / rate_hz;
    ReferencePoint const wanted = reference.at(state.time_s);
    validate_loop(plan, state, wanted);
    LoopTick const now = loop.tick(wanted, state.q, inertia * wanted.ddq);

    if (tick % ticks_per_sample == 0) {
      JointState moving = state;
      moving.ddq = plant.acceleration(state, now.acting);
      record_sample(recording, tick / ticks_per_sample, moving, wanted, now.measured, loop.logged(now), now.acting);
      recording.saturated_samples += loop.is_saturated(now);
    }
    loop.pass(now);

    // move on to the next tick
    for (double k = 0.0; k < substeps; ++k) state = plant.advance(state, now.acting, step_s);
  }
}

}  // namespace torquescope
