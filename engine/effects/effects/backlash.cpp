// Backlash: when the transmitted torque changes its sign the load is let go, and the motor is alone until a gap of 2 b
// has been crossed.
//
// Equation   tau = -(c_l tau_load + c_f Fc sign) while in the gap, + c_l J (dq - dq_load) as an impulse where they meet
//            again; tau_load, Fc, J: gravity and inertia, Coulomb levels, inertia of the baseline
// Memory     place q - q_load within [-b, b] and speed of the load, which slides on by itself in the gap: braked by the
//            Coulomb and viscous friction of the baseline, pulled by its gravity; the impact is plastic
// Why        the torque decides, not the velocity: a joint that gravity holds on one flank has no gap at its reversals
// Parameters backlash_load c_l, backlash_friction c_f [1] from 0 to 1: share of them that lies behind the gap;
//            backlash_half_gap b [rad; m]
// Signature  distance since the reversal of the torque: nothing to move for 2 b, then an impact
// Confused   presliding (reversal of the velocity), delay
// Source     Nordin, Gutman 2002; LESSONS.md item 10

#include <algorithm>
#include <cmath>

#include "engine/effects/memory_effect.hpp"

namespace torquescope::effects {
namespace {

class LoadInGap final : public EffectMemory {
 public:
  LoadInGap(double half_gap, JointScales const& scales) : half_gap_(half_gap), scales_(scales) {}

  void start(JointState const& state) override {
    q_ = state.q;
    flank_ = transmitted_torque(state) < 0.0 ? -1.0 : 1.0;
    place_ = flank_ * half_gap_;
    load_speed_ = state.dq;
    impact_torque_ = 0.0;
  }

  void advance(JointState const& state, double step_s) override {
    impact_torque_ = 0.0;
    if (flank_ == 0.0) {
      double const travelled = slide_load(step_s);
      place_ += state.q - q_ - travelled;
      if (std::abs(place_) >= half_gap_) meet(state, step_s);
    }
    q_ = state.q;
    if (flank_ != 0.0) {
      load_speed_ = state.dq;
      if (flank_ * transmitted_torque(state) < 0.0) flank_ = 0.0;
    }
  }

  void row(JointState const& state, std::span<double> out) const override {
    bool const is_free = flank_ == 0.0;
    out[0] = is_free ? -state.load_torque : impact_torque_;
    out[1] = is_free ? -coulomb(state.dq) : 0.0;
  }

 private:
  double coulomb(double velocity) const { return scales_.coulomb() * scales_.friction_sign(velocity); }
  double transmitted_torque(JointState const& state) const { return state.load_torque + coulomb(state.dq); }
  double gravity(double q) const { return scales_.gravity_sin * std::sin(q) + scales_.gravity_cos * std::cos(q); }

  // the load by itself for one step; returns how far it came
  double slide_load(double step_s) {
    double const weight = gravity(q_ - place_);
    double const level = scales_.coulomb();
    double const before = load_speed_;
    if (!(scales_.inertia > 0.0)) {
      load_speed_ = 0.0;  // without inertia friction stops it at once
      return 0.0;
    }
    double const direction = before != 0.0 ? std::copysign(1.0, before) : -std::copysign(1.0, weight);
    bool const is_held = before == 0.0 && std::abs(weight) <= level * std::abs(scales_.friction_sign(direction));
    if (is_held) return 0.0;
    double const braking = weight + coulomb(direction) + scales_.viscous * before;
    double const after = before - braking / scales_.inertia * step_s;
    // friction brings it to rest, it does not turn it round
    load_speed_ = before != 0.0 && after * before < 0.0 ? 0.0 : after;
    return 0.5 * (before + load_speed_) * step_s;
  }

  void meet(JointState const& state, double step_s) {
    flank_ = std::copysign(1.0, place_);
    place_ = flank_ * half_gap_;
    impact_torque_ = scales_.inertia * (state.dq - load_speed_) / step_s;
  }

  double half_gap_;
  JointScales scales_;
  double flank_ = 0.0;  // side of the gap the load lies on, 0 in between
  double place_ = 0.0;  // q - q_load
  double q_ = 0.0, load_speed_ = 0.0, impact_torque_ = 0.0;
};

class Backlash final : public MemoryEffect {
 public:
  Backlash()
      : MemoryEffect({.name = "backlash",
                      .title = "lost motion: the load is let go within a gap",
                      .equation = "-(c_l tau_load + c_f Fc sign(dq)) [in the gap 2 b] + c_l J (dq - dq_load) at impact",
                      .source = "Nordin, Gutman 2002",
                      .separated_by = "reversals with and without a load that holds one flank; encoders on both sides",
                      .parameters = {{"backlash_load", "1", "1", {0.0}, {1.0}},
                                     {"backlash_friction", "1", "1", {0.0}, {1.0}},
                                     shape_parameter("backlash_half_gap", "rad", "m", {1.0, RelativeTo::resolution},
                                                     {0.02, RelativeTo::position_range}, Spacing::logarithmic)},
                      .families = {EffectFamily::reversal},
                      .signature = {SignatureAxis::since_torque_reversal, SignatureAxis::acceleration},
                      .parity = Parity::neither,
                      .needs_baseline = true,
                      .is_dry_friction = true}) {}

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales) const override {
    return std::make_unique<LoadInGap>(shape[0], scales);
  }
};

}  // namespace

Effect const& backlash() {
  static Backlash const effect;
  return effect;
}

}  // namespace torquescope::effects
