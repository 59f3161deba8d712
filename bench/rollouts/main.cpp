// Joint steps a second and core of the lanes alone: sixteen trials of one joint along a minute at 1 kHz, sums of
// squares of both channels, in one thread. One line of JSON a case.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "engine/simulate/rollout/rollout_residuals.hpp"

using namespace torquescope;

namespace {

constexpr double rate_hz = 1000.0;
constexpr Eigen::Index samples = 60000;

RolloutTrack track() {
  RolloutTrack made;
  made.rate_hz = rate_hz;
  made.time_s = Eigen::VectorXd::LinSpaced(samples, 0.0, (samples - 1) / rate_hz);
  made.reference = (1.3 * made.time_s).array().sin() + 0.4 * (4.1 * made.time_s).array().sin();
  made.position = made.reference;
  made.torque = made.reference;
  made.segments = {{0, samples, 0.0, 0.0, 0.0}};
  return made;
}

RolloutTrial trial(double weight, double kd) {
  RolloutTrial made;
  made.joint = {0.09, 0.3, weight, 0.2 * weight};
  made.forward = 0.4;
  made.backward = -0.4;
  made.offset = 0.02;
  made.loop.kp = 60.0;
  made.loop.kd = kd;
  return made;
}

std::vector<RolloutTrial> trials(RolloutTrial const& first) {
  std::vector<RolloutTrial> all(replicate_lanes, first);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].joint.inertia *= 1.0 + 0.01 * static_cast<double>(i);
  return all;
}

void measure(char const* name, RolloutTrial const& first, std::vector<Effect const*> const& effects) {
  std::vector<RolloutTrack> const tracks{track()};
  RolloutStructure structure;
  structure.effects = effects;
  structure.step_s = longest_step_s(first, structure, tracks.front().tick_s());
  RolloutTask const task{tracks, {structure}};
  auto const all = trials(first);
  using Clock = std::chrono::steady_clock;
  double fastest_s = 1e9, sum = 0.0;
  constexpr int rounds = 9;
  for (int round = 0; round < rounds; ++round) {
    auto const start = Clock::now();
    sum += sums_of_squares(task, all, 1).front()[0];
    fastest_s = std::min(fastest_s, std::chrono::duration<double>(Clock::now() - start).count());
  }
  double const steps = std::ceil(tracks.front().tick_s() / structure.step_s * (1.0 - 1e-9));
  std::printf("{\"case\": \"%s\", \"steps_per_second\": %.4g, \"checksum\": %.17g}\n", name,
              static_cast<double>(samples) * static_cast<double>(replicate_lanes) * steps / fastest_s, sum);
}

RolloutTrial with_effect(std::vector<double> parameters) {
  RolloutTrial made = trial(0.0, 1.0);
  made.effects.push_back(std::move(parameters));
  return made;
}

}  // namespace

int main() {
  measure("friction joint, P loop", trial(0.0, 0.0), {});
  measure("friction joint, PD loop", trial(0.0, 1.0), {});
  measure("pendulum with friction, PD loop", trial(2.0, 1.0), {});
  Effect const* const stribeck = find_effect("stribeck");
  measure("friction joint with Stribeck, PD loop", with_effect({0.2, 0.1, 1.0}), {stribeck});
  Effect const* const cogging = find_effect("cogging");
  measure("friction joint with cogging, PD loop", with_effect({0.1, 0.1, 7.0}), {cogging});
  return 0;
}
