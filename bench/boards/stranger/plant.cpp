#include "stranger/plant.hpp"

#include <algorithm>
#include <cmath>

namespace stranger {
namespace {

// the part of the viscous friction that sits at the motor when there is a shaft between
constexpr double motor_side_viscous = 0.6;

}  // namespace

Plant::Plant(Rig rig, std::vector<std::unique_ptr<Effect>>& effects) : rig_{std::move(rig)}, effects_{effects} {
  for (auto const& effect : effects_) effect->build(structure_);
  at_.q = load_q_ = rig_.centre;
  elements_.assign(static_cast<std::size_t>(structure_.slip_elements), 0.0);
  // a shaft that carries a weight is wound up at the start
  if (structure_.shaft_stiffness > 0) load_q_ -= rig_.weight * std::sin(at_.q - rig_.hang) / structure_.shaft_stiffness;
}

double Plant::angle_seen() const {
  double q = at_.q;
  for (auto const& effect : effects_) q = effect->seen_angle(q);
  return q;
}

double Plant::kinetic_energy() const {
  double const motor = structure_.shaft_stiffness > 0 ? 1 - rig_.load_share : 1;
  return 0.5 * rig_.inertia * (motor * at_.v * at_.v + (1 - motor) * load_v_ * load_v_);
}

double Plant::shaft_torque() const {
  double const twist = at_.q - load_q_;
  double const touching = std::abs(twist) - structure_.gap;
  if (touching <= 0) return 0;
  double const side = twist > 0 ? 1 : -1;
  double const torque = structure_.shaft_stiffness * touching + structure_.shaft_damping * side * (at_.v - load_v_);
  if (structure_.gap <= 0) return side * torque;
  return side * std::max(0.0, torque);
}

void Plant::step_load(double torque, double h) {
  double const load = rig_.load_share * rig_.inertia;
  double const weight = rig_.weight * std::sin(load_q_ - rig_.hang);
  double const before = load_v_;
  load_v_ = (load_v_ + h / load * (torque - weight)) / (1 + h / load * rig_.viscous * (1 - motor_side_viscous));
  load_q_ += h * (before + load_v_) / 2;
}

double Plant::bristle_force(double level, double h) {
  double const way = at_.v * h;
  if (elements_.empty()) {
    // the exact solution of dz = v (1 - sign(v) z/length) dt over the step
    double const end = at_.v > 0 ? structure_.bristle_length : -structure_.bristle_length;
    double const before = bristle_;
    bristle_ = end + (bristle_ - end) * std::exp(-std::abs(way) / structure_.bristle_length);
    double const rate = (bristle_ - before) / h;
    return level / structure_.bristle_length * (bristle_ + structure_.bristle_damping * rate);
  }
  // slip elements of equal strength; their lengths are spread exponentially
  double sum = 0;
  auto const n = static_cast<double>(elements_.size());
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    double const length = -structure_.bristle_length * std::log1p(-(static_cast<double>(k) + 0.5) / n);
    elements_[k] = std::clamp(elements_[k] + way, -length, length);
    sum += elements_[k] / length;
  }
  return level * sum / n;
}

void Plant::step(double asked, double w, double h) {
  // what everything makes of this moment
  double made = asked;
  double hidden = 0;
  double dry = 0;
  double viscous = rig_.viscous;
  double inertia = rig_.inertia;
  double slope = 1;
  double bend = 0;
  for (auto const& effect : effects_) {
    made = effect->motor(made, at_);
    hidden += effect->torque(at_);
    dry += effect->dry(at_);
    viscous += effect->viscous(at_);
    inertia += effect->inertia(at_);
    slope += effect->gear_slope(at_.q);
    bend += effect->gear_bend(at_.q);
  }
  at_.drive = made;
  bool const two_bodies = structure_.shaft_stiffness > 0;
  double const through_shaft = two_bodies ? shaft_torque() : rig_.weight * std::sin(at_.q - rig_.hang);
  double const behind = rig_.load_share * rig_.inertia;
  if (two_bodies) inertia -= behind, viscous -= rig_.viscous * (1 - motor_side_viscous);
  inertia += behind * (slope * slope - 1);
  double const friction_ratio = 1 + rig_.load_share * (slope - 1);
  viscous *= friction_ratio;
  double const load = through_shaft + rig_.offset + hidden + behind * slope * bend * at_.v * at_.v;

  // free step, viscous friction implicitly, then dry friction as far as it reaches
  double const before = at_.v;
  double const divisor = inertia + h * viscous;
  double free = (inertia * before + h * (made + w - load)) / divisor;
  double dry_taken = 0;
  if (structure_.bristle_length > 0) {
    dry_taken = bristle_force((at_.v > 0 ? rig_.dry_forward : rig_.dry_backward) + dry, h);
    free -= h * dry_taken / divisor;
    at_.v = free;
  } else {
    double const level = std::max(0.0, ((free > 0 ? rig_.dry_forward : rig_.dry_backward) + dry) * friction_ratio);
    double const braking = h * level / divisor;
    at_.v = free > braking ? free - braking : free < -braking ? free + braking : 0;
    dry_taken = (free - at_.v) * divisor / h;
  }
  at_.a = (at_.v - before) / h;
  double const mean = (before + at_.v) / 2;
  at_.q += h * mean;
  at_.t += h;
  if (two_bodies) step_load(through_shaft, h);

  // bookkeeping: the rest since the last motion, and the way since the last rest
  if (at_.v == 0) {
    if (before != 0) at_.resting = 0;
    at_.resting += h, at_.slid = 0;
  } else {
    at_.slid += std::abs(h * mean);
  }
  double const known_dry = std::clamp(dry_taken, -rig_.dry_backward, rig_.dry_forward);
  double const seen_dry = at_.v > 0 ? rig_.dry_forward : at_.v < 0 ? -rig_.dry_backward : known_dry;
  unexplained_ = asked + w - rig_.inertia * at_.a - rig_.viscous * at_.v - seen_dry - rig_.offset -
                 rig_.weight * std::sin(at_.q - rig_.hang);
  driven_ += h * (made + w) * mean;
  lost_ += h * (viscous * at_.v + dry_taken + rig_.offset + hidden) * mean;
  for (auto const& effect : effects_) effect->advance(at_, h);
}

}  // namespace stranger
