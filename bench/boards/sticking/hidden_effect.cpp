#include "sticking/hidden_effect.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace sticking {
namespace {

constexpr double most_of_dry = 0.45;  // of the level that an effect may take away

// Armstrong-Helouvry 1991
HiddenEffect stribeck(Scale const& scale, Chance& chance) {
  double const speed = scale.speed * chance.log_between(0.005, 0.1), power = chance.between(0.6, 2.0);
  HiddenEffect effect{"stribeck", "reversal", "exponential", "stribeck"};
  effect.shapes = {{"stribeck_speed", speed}, {"stribeck_exponent", power}};
  effect.largest = 1.5 * scale.joint.dry();
  effect.dry = [=](Moment const& now) { return std::exp(-std::pow(std::abs(now.v) / speed, power)); };
  return effect;
}

// grease that thins (below 1: part of the dry friction, for it has no slope at rest) or a drag that grows
HiddenEffect power_law_viscous(Scale const& scale, Chance& chance) {
  bool const is_thinning = chance.happens(0.5);
  double const power = is_thinning ? chance.between(0.3, 0.7) : chance.between(1.4, 2.0);
  HiddenEffect effect{"power_law_viscous",
                      "velocity_law",
                      is_thinning ? "less_than_in_proportion" : "more_than_in_proportion",
                      "power_law_viscous",
                      {{"power_law_exponent", power}}};
  effect.largest = 2.0 * scale.torque_rms / std::pow(scale.speed, power);
  if (is_thinning) {
    effect.dry = [=](Moment const& now) { return std::pow(std::abs(now.v), power); };
  } else {
    effect.torque = [=](Moment const& now) { return std::copysign(std::pow(std::abs(now.v), power), now.v); };
  }
  return effect;
}

HiddenEffect speed_drag(Scale const& scale, Chance& chance) {
  double const cubic = chance.happens(0.5) ? 0.0 : chance.between(0.2, 1.0) / scale.speed;
  HiddenEffect effect{"speed_drag",
                      "velocity_law",
                      cubic > 0.0 ? "quadratic_and_cubic" : "quadratic",
                      "quadratic_drag",
                      {{"cubic_over_quadratic", cubic}}};
  effect.largest = 0.5 * scale.torque_rms / (scale.speed * scale.speed);
  effect.torque = [=](Moment const& now) { return now.v * std::abs(now.v) * (1.0 + cubic * std::abs(now.v)); };
  return effect;
}

HiddenEffect asymmetric_viscous(Scale const& scale, Chance& chance) {
  HiddenEffect effect{"asymmetric_viscous", "velocity_law", "magnitude_of_speed", "asymmetric_viscous"};
  double const sign = effect.sign = chance.sign();
  effect.largest = 0.5 * scale.joint.viscous;
  effect.torque = [=](Moment const& now) { return sign * std::abs(now.v); };
  return effect;
}

// a bearing pressed by the weight, and by a preload besides
HiddenEffect load_dependent_friction(Scale const& scale, Chance& chance) {
  double const heaviest = std::hypot(scale.joint.gravity_sin, scale.joint.gravity_cos);
  double const preload = chance.happens(0.5) ? 0.0 : heaviest * chance.between(0.1, 0.5);
  HiddenEffect effect{"load_dependent_friction",
                      "load",
                      "weight_and_preload",
                      "load_dependent_friction",
                      {{"load_friction_inertia_share", 0.0}, {"load_friction_preload", preload}}};
  effect.largest = 0.3;
  effect.dry = [=](Moment const& now) { return std::hypot(now.weight, preload) - preload; };
  return effect;
}

HiddenEffect position_dependent_friction(Scale const& scale, Chance& chance) {
  double const centre = scale.centre;
  HiddenEffect effect{"position_dependent_friction", "static_position", "slope", "position_friction_slope"};
  double const sign = effect.sign = chance.sign();
  if (chance.happens(0.3)) {
    effect.largest = 2.0 * most_of_dry * scale.joint.dry() / scale.travel;
    effect.dry = [=](Moment const& now) { return sign * (now.q - centre); };
    return effect;
  }
  double const order = turn * chance.between(0.7, 4.0) / scale.travel, phase = chance.angle();
  effect.form = "wave", effect.amplitude_name = "position_friction_amplitude";
  effect.shapes = {{"position_friction_order", order}, {"phase", phase}};
  effect.largest = most_of_dry * scale.joint.dry();
  effect.dry = [=](Moment const& now) { return sign * std::cos(order * now.q + phase); };
  return effect;
}

// 2 to 12 waves a turn, of which the motion passes two at least
double draw_order(Scale const& scale, Chance& chance) {
  double const fewest = std::max(2.0, std::ceil(2.2 * turn / scale.travel));
  return std::floor(chance.between(fewest, std::max(fewest, 12.0) + 0.999));
}

HiddenEffect cogging(Scale const& scale, Chance& chance) {
  double const order = draw_order(scale, chance), phase = chance.angle();
  HiddenEffect effect{
      "cogging", "order_locked", "one_wave", "cogging_amplitude", {{"cogging_order", order}, {"phase", phase}}};
  effect.largest = order > 12.0 ? 0.0 : 3.0 * scale.torque_rms;
  effect.torque = [=](Moment const& now) { return std::cos(order * now.q + phase); };
  return effect;
}

HiddenEffect spring(Scale const& scale, Chance& chance) {
  double const centre = scale.centre;
  HiddenEffect effect{"spring", "static_position", "straight", "spring"};
  double const sign = effect.sign = chance.sign();
  effect.largest = 5.0 * scale.torque_rms / scale.travel;
  effect.torque = [=](Moment const& now) { return sign * (now.q - centre); };
  return effect;
}

HiddenEffect torque_constant(Scale const& scale, Chance&) {
  HiddenEffect effect{"torque_constant", "load", "cubic", "torque_constant"};
  effect.largest = 0.2 / (scale.torque_rms * scale.torque_rms);
  effect.lost = [](Moment const&, double given) { return given * given * given; };
  return effect;
}

HiddenEffect torque_ripple(Scale const& scale, Chance& chance) {
  double const order = draw_order(scale, chance), phase = chance.angle();
  HiddenEffect effect{"torque_ripple",
                      "order_locked",
                      "one_wave",
                      "torque_ripple_amplitude",
                      {{"torque_ripple_order", order}, {"phase", phase}}};
  effect.largest = order > 12.0 ? 0.0 : 0.3;
  effect.lost = [=](Moment const& now, double given) { return given * std::cos(order * now.q + phase); };
  return effect;
}

// warms up or loosens anew in each recording
HiddenEffect friction_drift(Scale const& scale, Chance& chance) {
  HiddenEffect effect{"friction_drift", "time", "straight", "friction_drift_coulomb_times_duration"};
  double const sign = effect.sign = chance.sign();
  effect.largest = most_of_dry * scale.joint.dry();
  if (chance.happens(0.5)) {
    effect.dry = [=](Moment const& now) { return sign * now.t / duration_s; };
    return effect;
  }
  double const when = duration_s * chance.between(0.2, 0.8);
  effect.form = "step", effect.amplitude_name = "friction_step", effect.shapes = {{"friction_step_time", when}};
  effect.dry = [=](Moment const& now) { return now.t < when ? 0.0 : sign; };
  return effect;
}

HiddenEffect delay(Scale const&, Chance&) {
  HiddenEffect effect{"delay", "acceleration", "late_torque", "delay"};
  effect.largest = longest_delay_s;
  return effect;
}

// a machine nearby, which does not wait for the recording: its phase is each recording's own
HiddenEffect periodic_disturbance(Scale const& scale, Chance& chance) {
  double const hz = chance.log_between(0.3, std::min(6.0, 0.6 * scale.highest_hz)), phase = chance.angle();
  HiddenEffect effect{"periodic_disturbance",
                      "outside",
                      "one_wave",
                      "periodic_disturbance_amplitude",
                      {{"disturbance_frequency", hz}, {"phase", phase}}};
  effect.largest = 3.0 * scale.torque_rms;
  effect.torque = [=](Moment const& now) { return std::cos(turn * hz * now.t + phase); };
  return effect;
}

struct Drawn {
  std::string name;
  HiddenEffect (*draw)(Scale const&, Chance&);
};

std::array<Drawn, 13> const& drawn_effects() {
  static std::array<Drawn, 13> const all{{{"stribeck", stribeck},
                                          {"power_law_viscous", power_law_viscous},
                                          {"speed_drag", speed_drag},
                                          {"asymmetric_viscous", asymmetric_viscous},
                                          {"load_dependent_friction", load_dependent_friction},
                                          {"position_dependent_friction", position_dependent_friction},
                                          {"cogging", cogging},
                                          {"spring", spring},
                                          {"torque_constant", torque_constant},
                                          {"torque_ripple", torque_ripple},
                                          {"friction_drift", friction_drift},
                                          {"delay", delay},
                                          {"periodic_disturbance", periodic_disturbance}}};
  return all;
}

}  // namespace

std::vector<std::string> const& effect_names() {
  static std::vector<std::string> const names = [] {
    std::vector<std::string> all;
    for (Drawn const& one : drawn_effects()) all.push_back(one.name);
    return all;
  }();
  return names;
}

bool needs_gravity(std::string const& name) { return name == "load_dependent_friction"; }

HiddenEffect draw_effect(std::string const& name, Scale const& scale, Chance& chance) {
  for (Drawn const& one : drawn_effects())
    if (one.name == name) return one.draw(scale, chance);
  throw std::invalid_argument("no effect of the board is called " + name);
}

}  // namespace sticking
