#include "sticking/dry_friction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sticking {
namespace {

constexpr double widest_angle = 0.1;  // rad of a bristle's oscillation in one step

}  // namespace

std::string to_text(Law law) {
  switch (law) {
    case Law::coulomb:
      return "coulomb";
    case Law::creep:
      return "creep";
    case Law::dahl:
      return "dahl";
    case Law::elastoplastic:
      return "elastoplastic";
    case Law::lugre:
      break;
  }
  return "lugre";
}

DryFriction::DryFriction(StickingLaw law, Body body, double usual_level, double seconds)
    : law_(law), body_(body), step_s_(seconds) {
  if (!law_.has_bristles()) return;
  stiffness_ = usual_level / law_.length;
  damping_ = law_.damping * 2.0 * std::sqrt(stiffness_ * body_.inertia);
  double const angle = step_s_ * std::sqrt(stiffness_ / body_.inertia);
  parts_ = std::max(1, static_cast<int>(std::ceil(angle / widest_angle)));
}

double DryFriction::step(double v, double torque, double level_forward, double level_backward) {
  if (law_.law == Law::coulomb) return hold_or_slide(v, torque, level_forward, level_backward);
  if (law_.law == Law::creep) return creep(v, torque, level_forward, level_backward);
  return bend(v, torque, level_forward, level_backward);
}

double DryFriction::hold_or_slide(double v, double torque, double forward, double backward) {
  // backward Euler of the set-valued law: friction takes what it can and never turns the joint round
  double const mass = body_.inertia + step_s_ * body_.viscous;
  double const free = (body_.inertia * v + step_s_ * torque) / mass;
  double const braking = step_s_ / mass * (free > 0.0 ? forward : backward);
  double const after = free > braking ? free - braking : free < -braking ? free + braking : 0.0;
  torque_ = (free - after) * mass / step_s_;
  return after;
}

double DryFriction::creep(double v, double torque, double forward, double backward) {
  // backward Euler: mass x + h level tanh(x / speed) = drive, which is concave for x > 0. Newton's method climbs to the
  // root from a point that is surely before it
  double const mass = body_.inertia + step_s_ * body_.viscous;
  double const signed_drive = body_.inertia * v + step_s_ * torque;
  double const drive = std::abs(signed_drive);
  double const brake = step_s_ * (signed_drive > 0.0 ? forward : backward);
  double x = std::max(0.0, (drive - brake) / mass);
  for (int round = 0; round < 100; ++round) {
    double const wave = std::tanh(x / law_.speed);
    double const slope = mass + brake / law_.speed * (1.0 - wave * wave);
    double const change = (drive - mass * x - brake * wave) / slope;
    x += change;
    if (std::abs(change) <= 1e-13 * (x + law_.speed)) break;
  }
  double const after = std::copysign(x, signed_drive);
  torque_ = (signed_drive - mass * after) / step_s_;
  return after;
}

double DryFriction::slipping(double v, double greatest_bend) const {
  if (law_.law != Law::elastoplastic) return 1.0;
  if (v * bend_ < 0.0) return 0.0;
  double const first = law_.elastic * greatest_bend;
  double const now = std::abs(bend_);
  if (now <= first) return 0.0;
  if (now >= greatest_bend) return 1.0;
  double const middle = 0.5 * (greatest_bend + first);
  return 0.5 + 0.5 * std::sin(std::numbers::pi * (now - middle) / (greatest_bend - first));
}

double DryFriction::bend(double v, double torque, double forward, double backward) {
  double const h = step_s_ / parts_;
  double sum = 0.0;
  for (int part = 0; part < parts_; ++part) {
    sum += bristles_;
    v = (body_.inertia * v + h * (torque - bristles_)) / (body_.inertia + h * body_.viscous);
    // the bend along the way of this part, exact for a slip that stays as it is
    double const greatest = (v > 0.0 ? forward : backward) / stiffness_;
    double const slip = slipping(v, greatest);
    double const before = bend_;
    double const way = v * h;
    if (slip > 0.0) {
      double const end = std::copysign(greatest / slip, v);
      bend_ = end + (bend_ - end) * std::exp(-slip * std::abs(way) / greatest);
    } else {
      bend_ += way;
    }
    // a long way in one part does not bend bristles further than they go
    if (std::abs(before) <= greatest) bend_ = std::clamp(bend_, -greatest, greatest);
    bristles_ = stiffness_ * bend_ + damping_ * (bend_ - before) / h;
  }
  torque_ = sum / parts_;
  return v;
}

}  // namespace sticking
