#include "engine/simulate/closed_loop.hpp"

#include <fmt/format.h>

#include <cmath>

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

// what is written down at a sample
void record_sample(SimulatedRecording& recording, Eigen::Index i, JointState const& state, ReferencePoint const& wanted,
                   double measured_position, double logged_torque, double motor_torque, double acceleration) {
  recording.time_s[i] = state.time_s;
  recording.reference[i] = wanted.q;
  recording.position[i] = measured_position;
  recording.torque[i] = logged_torque;
  recording.true_position[i] = state.q;
  recording.true_velocity[i] = state.dq;
  recording.true_acceleration[i] = acceleration;
  recording.true_torque[i] = motor_torque;
}

}  // namespace

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
  NoiseOptions const& noise = plan.noise;
  JointPlant const plant(plan.plant);
  Encoder const encoder(plan.encoder);
  ReferencePoint const start = reference.at(0.0);
  JointState state{0.0, start.q, start.dq, 0.0};
  Controller controller(plan.controller, rate_hz, plant.inertia(state), start);
  ColouredNoise position_noise(key, NoiseStream::position, noise.position_std, 0.0, rate_hz);
  ColouredNoise disturbance(key, NoiseStream::disturbance, noise.disturbance_std, noise.disturbance_s, rate_hz);
  ColouredNoise white(key, NoiseStream::torque_white, noise.torque_std, 0.0, recording.rate_hz);
  ColouredNoise coloured(key, NoiseStream::torque_coloured, noise.torque_coloured_std, noise.torque_coloured_s,
                         recording.rate_hz);
  recording.gains = controller.gains();
  recording.controller_rate_hz = rate_hz;

  bool const averaged = plan.controller.torque_log == "averaged";
  double torque_before = 0.0;
  for (Eigen::Index tick = 0; tick < samples * ticks_per_sample; ++tick) {
    // measure and answer
    state.time_s = static_cast<double>(tick) / rate_hz;
    ReferencePoint const wanted = reference.at(state.time_s);
    validate_loop(plan, state, wanted);
    double const measured = encoder.read(state.q + position_noise.next());
    double const torque = controller.command(wanted, measured);
    double const acting = torque + disturbance.next();

    if (tick % ticks_per_sample == 0) {
      double const logged = averaged && tick > 0 ? 0.5 * (torque_before + torque) : torque;
      record_sample(recording, tick / ticks_per_sample, state, wanted, measured,
                    logged + white.next() + coloured.next(), acting, plant.acceleration(state, acting));
      double const limit = plan.controller.torque_limit;
      recording.saturated_samples += limit > 0.0 && std::abs(torque) >= limit;
    }
    torque_before = torque;

    // move on to the next tick
    for (double k = 0.0; k < substeps; ++k) state = plant.advance(state, acting, step_s);
  }
}

}  // namespace torquescope
