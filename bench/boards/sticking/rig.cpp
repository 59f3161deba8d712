// Which joint, drive, controller, encoder and sticking law a case has.
#include "sticking/rig.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sticking {
namespace {

// What stays when a joint is drawn anew: else coarse encoders, whose loops are often refused, would be rare
struct Manner {
  Law law = Law::coulomb;
  int encoder_bits = 17;
  bool commanded = false, strokes = false;
};

Manner draw_manner(Address at) {
  static constexpr std::array laws{Law::coulomb, Law::creep, Law::dahl, Law::elastoplastic, Law::lugre};
  at.attempt = 0;
  Chance chance{at, Purpose::manner};
  Manner manner;
  manner.law = laws[chance.index(laws.size())];
  manner.encoder_bits = chance.happens(0.35) ? 12 : 17;
  manner.commanded = chance.happens(0.5);
  manner.strokes = chance.happens(0.5);
  return manner;
}

MotionLimits draw_limits(Manner const& manner, Chance& chance) {
  MotionLimits limits;
  limits.strokes = manner.strokes;
  limits.centre = chance.between(-1.5, 1.5);
  limits.travel = chance.log_between(1.2, 5.0);
  limits.speed = std::min(5.0, std::numbers::pi * limits.travel * chance.log_between(0.08, 0.5));
  limits.resting_share = chance.happens(0.3) ? 0.0 : chance.between(0.2, 0.7);
  return limits;
}

double usual_acceleration(MotionLimits const& limits) { return 2.0 * limits.speed * limits.speed / limits.travel; }

// sizes relative to what the motion asks of the inertia
Joint draw_joint(MotionLimits const& limits, bool needs_gravity, Chance& chance) {
  Joint joint;
  joint.inertia = chance.log_between(0.003, 1.0);
  double const inertial = joint.inertia * usual_acceleration(limits);
  double const dry = inertial * chance.log_between(0.4, 4.0);
  double const uneven = chance.happens(0.4) ? chance.sign() * chance.between(0.05, 0.25) : 0.0;
  joint.dry_forward = dry * (1.0 + uneven);
  joint.dry_backward = dry * (1.0 - uneven);
  joint.viscous = dry * chance.log_between(0.2, 1.5) / limits.speed;
  joint.offset = dry * chance.between(-0.3, 0.3);
  joint.has_gravity = chance.happens(0.35) || needs_gravity;
  if (joint.has_gravity) {
    double const weight = (inertial + dry) * chance.between(0.5, 2.0);
    double const hang = chance.between(-0.8, 0.8);
    joint.gravity_sin = weight * std::cos(hang);
    joint.gravity_cos = -weight * std::sin(hang);
  }
  return joint;
}

Reading draw_reading(Manner const& manner, Chance& chance) {
  Reading reading;
  reading.log_hz = chance.happens(0.7) ? 200.0 : 500.0;
  reading.encoder_bits = manner.encoder_bits;
  reading.encoder_phase = chance.uniform();
  reading.commanded = manner.commanded;
  reading.lag_s = chance.log_between(0.2e-3, 2e-3);
  reading.noise_share = chance.log_between(1e-3, 5e-3);
  return reading;
}

StickingLaw draw_sticking(Law law, Reading const& reading, Chance& chance) {
  StickingLaw sticking;
  sticking.law = law;
  double const speed = chance.log_between(0.1e-3, 20e-3);
  double const length = chance.log_between(0.5 * reading.encoder_step(), 5e-3);
  double const damping = chance.between(0.05, 0.7);
  double const elastic = chance.between(0.3, 0.9);
  if (sticking.law == Law::creep) sticking.speed = speed;
  if (sticking.has_bristles()) sticking.length = length;
  if (sticking.law == Law::lugre || sticking.law == Law::elastoplastic) sticking.damping = damping;
  if (sticking.law == Law::elastoplastic) sticking.elastic = elastic;
  return sticking;
}

// A step of the encoder comes through the gain on the speed as a pulse of torque; gains are as high as the pulses allow
Control draw_control(Joint const& joint, double usual_torque, Reading const& reading, Chance& chance) {
  Control control;
  control.cascade = chance.happens(joint.has_gravity ? 0.75 : 0.4);
  control.rate_hz = chance.happens(0.5) ? 1000.0 : reading.log_hz;
  double const damping = chance.between(0.7, 1.1);
  double const filter_ratio = chance.between(6.0, 12.0);  // corner of the speed's filter over the loop's
  double const widest = turn * std::min(15.0, 0.05 * control.rate_hz) * chance.between(0.5, 1.0);
  double const pulse_share = chance.log_between(0.03, 0.2);  // of the usual torque
  double const pulse_per_omega2 = 2.0 * damping * joint.inertia * filter_ratio * reading.encoder_step();
  double const quiet = std::sqrt(pulse_share * usual_torque / pulse_per_omega2);
  double const omega = std::max(turn * 1.0, std::min(widest, quiet));
  if (control.cascade) {
    control.speed_gain = 2.0 * damping * joint.inertia * omega;
    control.position_gain = omega / 2.5;
    control.integral_gain = control.speed_gain * omega * chance.between(0.15, 0.3);
  } else {
    control.position_gain = joint.inertia * omega * omega;
    control.speed_gain = 2.0 * damping * joint.inertia * omega;
  }
  control.speed_filter_hz = std::min(0.25 * control.rate_hz, filter_ratio * omega / turn);
  return control;
}

// rms of the acceleration that a low-pass leaves of the encoder's rounding, taken as white
double rounding_acceleration(Reading const& reading, double cutoff_hz) {
  double const rounding = reading.encoder_step() / std::sqrt(12.0), omega = turn * cutoff_hz;
  return rounding * omega * omega * std::sqrt(0.4 * cutoff_hz / reading.log_hz);
}

// as somebody chooses it who looks at the acceleration: no cut-off at which rounding drowns it
Smoothing draw_smoothing(Reading const& reading, double acceleration, Chance& chance) {
  static constexpr std::array<Smoothing, 6> choices{{{true, 10, 5, 25},
                                                     {true, 20, 10, 50},
                                                     {true, 30, 15, 50},
                                                     {true, 40, 20, 50},
                                                     {true, 40, 20, 100},
                                                     {true, 60, 30, 100}}};
  double const bearable = acceleration * chance.log_between(0.1, 0.4);
  std::size_t usable = 1;
  while (usable < choices.size() && rounding_acceleration(reading, choices[usable].cutoff_hz) < bearable) ++usable;
  Smoothing const chosen = choices[usable - 1 - chance.index(std::min<std::size_t>(usable, 3))];
  return chance.happens(0.3) ? Smoothing{} : chosen;
}

}  // namespace

double Joint::weight(double q) const {
  return has_gravity ? gravity_sin * std::sin(q) + gravity_cos * std::cos(q) : 0.0;
}

double Reading::encoder_step() const { return turn / std::exp2(encoder_bits); }

Rig draw_rig(Address const& at, bool needs_gravity) {
  Manner const manner = draw_manner(at);
  Chance chance{at, Purpose::rig};
  Rig rig;
  rig.limits = draw_limits(manner, chance);
  rig.joint = draw_joint(rig.limits, needs_gravity, chance);
  rig.reading = draw_reading(manner, chance);
  rig.sticking = draw_sticking(manner.law, rig.reading, chance);
  double const usual_torque = rig.joint.dry() + rig.joint.inertia * usual_acceleration(rig.limits);
  rig.control = draw_control(rig.joint, usual_torque, rig.reading, chance);
  rig.smoothing = draw_smoothing(rig.reading, usual_acceleration(rig.limits), chance);
  return rig;
}

}  // namespace sticking
