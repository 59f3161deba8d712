#include "stranger/recording.hpp"

#include <cmath>
#include <deque>
#include <numbers>

#include "stranger/path.hpp"
#include "stranger/plant.hpp"

namespace stranger {
namespace {

// torque with a past: what a late channel shows is interpolated between two ticks
class LateChannel {
 public:
  LateChannel(double late_s, double tick_s) : ticks_{late_s / tick_s} {}
  double pass(double now) {
    past_.push_front(now);
    auto const whole = static_cast<std::size_t>(ticks_);
    if (past_.size() > whole + 2) past_.pop_back();
    if (past_.size() < whole + 2) return past_.back();
    double const rest = ticks_ - std::floor(ticks_);
    return past_[whole] * (1 - rest) + past_[whole + 1] * rest;
  }

 private:
  double ticks_;
  std::deque<double> past_;
};

std::vector<std::unique_ptr<Effect>> concealed(Case const& which, Rig const& rig, Options const& options,
                                               std::string const& stream) {
  std::vector<std::unique_ptr<Effect>> effects;
  if (options.without) return effects;
  bool const validation = stream.ends_with("unseen");
  int number = 0;
  for (auto law : which.laws) {
    if (options.only >= 0 && options.only != number++) continue;
    // nobody leans on it twice
    if (validation && law.form == "leaning") continue;
    law.values.at(0) *= options.scale;
    effects.push_back(make_effect(law, rig, stream));
  }
  return effects;
}

}  // namespace

std::vector<Sample> record(Case const& which, bool validation, Options const& options) {
  std::string const stream = which.name + (validation ? "/unseen" : "/train");
  Rig const rig = find_rig(which.rig);
  Instruments const& seen_by = which.instruments;
  double const tick_s = 1 / which.loop.rate_hz;
  auto const path = make_path(validation ? which.validation_motion : which.train_motion, rig, tick_s,
                              validation ? which.validation_s : which.train_s, Chance{stream, "path"});
  auto effects = concealed(which, rig, options, stream);
  double late_s = 0;
  for (auto const& effect : effects) late_s += effect->torque_lateness();
  Plant plant{rig, effects};
  Drive drive{which.loop, rig, rig.centre};
  LateChannel late{late_s, tick_s};
  Chance white{stream, "white"};
  Chance outside{stream, "outside"};

  auto const ticks_per_sample = static_cast<std::size_t>(std::lround(which.loop.rate_hz / seen_by.log_hz));
  double const keep = std::exp(-2 * std::numbers::pi * seen_by.coloured_hz * tick_s);
  double const refresh = std::sqrt(1 - keep * keep) * seen_by.coloured * rig.torque_rms;
  auto const rounded = [&](double q) { return std::round(q * seen_by.counts_per_unit) / seen_by.counts_per_unit; };
  double push = 0;
  double torque_sum = 0;
  double unexplained_sum = 0;
  double torque_shown = 0;
  std::vector<Sample> samples;
  samples.reserve(path.size() / ticks_per_sample + 1);
  for (std::size_t tick = 0; tick < path.size(); ++tick) {
    double const seen = rounded(plant.angle_seen());
    if (tick % ticks_per_sample == 0) {
      double const n = tick == 0 ? 1 : static_cast<double>(ticks_per_sample);
      double const torque = seen_by.mean_torque ? torque_sum / n : torque_shown;
      double const noise = options.noise ? seen_by.white * rig.torque_rms * white.normal() : 0;
      double const tacho = options.noise ? 0.002 * rig.top_speed * outside.normal() : 0;
      samples.push_back({plant.time(), path[tick], seen, plant.speed() + tacho, torque + noise, unexplained_sum / n});
      torque_sum = unexplained_sum = 0;
    }
    push = keep * push + (options.pushes ? refresh * outside.normal() : 0);
    double const asked = drive.tick(path[tick], seen);
    torque_shown = late.pass(asked);
    for (auto const& effect : effects) torque_shown = effect->seen_torque(torque_shown, plant.time());
    torque_sum += torque_shown;
    double left = 0;
    for (int part = 0; part < options.steps_per_tick; ++part) {
      plant.step(asked, push, tick_s / options.steps_per_tick);
      left += plant.unexplained() / options.steps_per_tick;
    }
    unexplained_sum += left + torque_shown - asked;
  }
  return samples;
}

}  // namespace stranger
