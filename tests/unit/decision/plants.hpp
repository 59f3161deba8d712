#pragma once
// Joints in closed form: the motion is given, the torque is what the equation of the joint asks for on it.
//
// Motion     a sum of sines of a phase. The phase is the time; of a joint that rests it stops 1.5 s in every 4 s
// Friction   coulomb times the sign of the speed; in a rest it leaves that value, comes back, and never reaches the
//            other end of its interval
// Late       the torque channel shows the torque of an earlier instant; the position channel shows encoder steps

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "engine/base/random_stream.hpp"
#include "engine/data/motion.hpp"
#include "engine/effects/regressor.hpp"
#include "engine/infer/decision/strip.hpp"

namespace torquescope::test {

struct GivenJoint {
  double inertia = 0.5, viscous = 1.0, coulomb = 0.6, offset = 0.2;
  std::function<double(double q, double dq)> effect{};  // beside these terms; none
  double late_s = 0.0, noise = 0.005, encoder_step = 2e-5;
  bool rests = false;
  double pace = 1.0;  // of the phase: another recording of the same joint moves at another one
  std::uint64_t seed = 1;
  std::function<double(double t, double q)> timed{};  // of a clock or an instant
};

struct Phase {
  double at = 0.0, rate = 1.0, rate_change = 0.0;
  double rest = -1.0;  // how much of a rest has passed, from 0 to 1; negative: it moves
};

inline constexpr double rest_period_s = 4.0, slows_s = 1.9, rest_from_s = 2.2, rest_until_s = 3.7;

inline Phase phase_at(double t, bool rests) {
  if (!rests) return {t};
  constexpr double pi = std::numbers::pi, slowing_s = rest_from_s - slows_s, moved = slows_s + slowing_s;
  double const periods = std::floor(t / rest_period_s), u = t - periods * rest_period_s, before = periods * moved;
  if (u < slows_s) return {before + u};
  // the rate falls and rises as half a cosine
  auto const ramp = [&](double x) { return 0.5 * (x - slowing_s / pi * std::sin(pi * x / slowing_s)); };
  auto const bend = [&](double x) { return 0.5 * pi / slowing_s * std::sin(pi * x / slowing_s); };
  double const half = slows_s + 0.5 * slowing_s;
  if (u < rest_from_s) {
    double const x = u - slows_s;
    return {before + slows_s + x - ramp(x), 0.5 * (1.0 + std::cos(pi * x / slowing_s)), -bend(x)};
  }
  if (u < rest_until_s) return {before + half, 0.0, 0.0, (u - rest_from_s) / (rest_until_s - rest_from_s)};
  double const x = u - rest_until_s;
  return {before + half + ramp(x), 0.5 * (1.0 - std::cos(pi * x / slowing_s)), bend(x)};
}

struct Instant {
  double q = 0.0, dq = 0.0, ddq = 0.0, friction = 0.0;  // friction: from -1 to 1
};

inline Instant instant_of(GivenJoint const& joint, double t) {
  struct Wave {
    double size, hz, shift;
  };
  Phase const phase = phase_at(t, joint.rests);
  double q = 0.0, slope = 0.0, bend = 0.0;
  for (auto const& [size, hz, shift] : {Wave{0.6, 0.23, 0.4}, Wave{0.3, 0.61, 1.0}, Wave{0.12, 1.33, 2.0}}) {
    double const turns = 2.0 * std::numbers::pi * hz * joint.pace, angle = turns * phase.at + shift;
    q += size * std::sin(angle);
    slope += size * turns * std::cos(angle);
    bend -= size * turns * turns * std::sin(angle);
  }
  double const side = slope > 0.0 ? 1.0 : -1.0;
  double const friction = phase.rest < 0.0 ? side : side * (1.0 - 1.5 * std::sin(std::numbers::pi * phase.rest));
  return {q, slope * phase.rate, bend * phase.rate * phase.rate + slope * phase.rate_change, friction};
}

inline double torque_of(GivenJoint const& joint, double t) {
  auto const [q, dq, ddq, friction] = instant_of(joint, t);
  double const effect = joint.effect ? joint.effect(q, dq) : 0.0;
  return joint.inertia * ddq + joint.viscous * dq + joint.coulomb * friction + joint.offset + effect +
         (joint.timed ? joint.timed(t, q) : 0.0);
}

inline Recording recording_of(GivenJoint const& joint, double duration_s = 20.0, double rate_hz = 200.0) {
  auto const n = static_cast<Eigen::Index>(duration_s * rate_hz);
  Recording made;
  made.name = "closed_form";
  made.rate_hz = rate_hz;
  made.time_s = made.position = made.torque = Eigen::VectorXd::Zero(n);
  made.rows.encoder_step = joint.encoder_step;
  RandomStream random({joint.seed, 0, RandomDomain::test}, 0, 0);
  for (Eigen::Index k = 0; k < n; ++k) {
    double const t = static_cast<double>(k) / rate_hz;
    made.time_s[k] = t;
    made.position[k] = joint.encoder_step * std::round(instant_of(joint, t).q / joint.encoder_step);
    made.torque[k] = torque_of(joint, t - joint.late_s) + joint.noise * random.normal();
  }
  return made;
}

// A torque column is read as one that holds from sample to sample (held_torque.hpp). In closed form it does not hold,
// and a strip shows it half a sample late
inline constexpr double half_sample_s = 0.0025;

inline FilterOptions ten_hertz() {
  FilterOptions filter;
  filter.cutoff_hz = 10.0;
  filter.decimate_to_hz = 25.0;
  return filter;
}

inline Strip strip_of_joint(GivenJoint const& joint) {
  Recording const recording = recording_of(joint);
  return strip_of(recording, strip_filters(recording, ten_hertz(), {}));
}

inline Regressor joint_terms() { return {{"inertia", "viscous", "coulomb", "offset"}, JointKind::revolute}; }

inline Eigen::Vector4d truth_of(GivenJoint const& joint) {
  return {joint.inertia, joint.viscous, joint.coulomb, joint.offset};
}

}  // namespace torquescope::test
