// Backlash: the load hangs behind a gap of 2 b whose flanks give way, and lies on the one or the other only while it is
// pushed.
//
// Equation   tau = J_l y'' + d J_l Fv y' / J, y'' = a - ddq - g / J - d Fv (dq + y') / J, a = -(w^2 dz(y, b) + 2 zeta w y'), w = 2 pi f:
//            y is the load relative to the motor, dz its way beyond the gap; a = -c y' in the gap, which grease fills, and where a
//            flank would pull. The rigid part J_l ddq, the gravity g and the viscous friction Fv are the baseline's; the load has the same
//            share of gravity as of the inertia J, and d times that share of the viscous friction
// Memory     y and y', exact on a flank and in the gap for an acceleration that runs straight between two samples; the
//            instant of contact or release is searched within sub-steps of 1/4 rad of the contact frequency
// Why        flanks are soft: a rigid load and a plastic impact miss the ringing after contact, which is most of what shows.
//            The push decides, not the velocity: a joint that gravity holds on one flank has no gap at its reversals
// Parameters backlash_load_inertia J_l >= 0 [kg m2; kg], up to four times the fitted inertia (joint_elasticity.cpp); backlash_half_gap b [rad; m];
//            backlash_frequency f [Hz]: of the load in contact with the motor held; backlash_damping zeta [1];
//            backlash_film c [1/s]: how fast grease takes the speed of a load that crosses the gap. Without it a film passes
//            for a wider gap; backlash_load_drag d [1]: a load that is braked by itself turns against the joint before
//            that turns, and lies on the other flank when it does
// Signature  distance since the reversal of the torque: the load is missing for 2 b, then blows and rings
// Confused   joint_elasticity (no gap), presliding (reversal of the velocity), delay
// Source     Nordin, Gutman 2002; LESSONS.md item 10

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/effects/memory_effect.hpp"

namespace torquescope::effects {
namespace {

// load relative to motor
struct Place {
  double y = 0.0, dy = 0.0;
};

// what the motor and gravity do to the load relative to the motor, on one side: y'' = -(now + jerk t) without contact
struct Drive {
  double now = 0.0, jerk = 0.0;
  Drive after(double time_s) const { return {now + jerk * time_s, jerk}; }
};

// across the gap
class Grease {
 public:
  // drag: of the load by itself, which the motor does not feel
  Grease(double film_per_s, double drag_per_s) : push_per_s_(film_per_s), film_per_s_(film_per_s + drag_per_s) {}

  double push(Place const& at) const { return push_per_s_ * at.dy; }

  Place fly(Place const& from, Drive const& drive, double time_s) const {
    return film_per_s_ * time_s < thin ? fly_freely(from, drive, time_s)
                                       : fly(from, drive, time_s, -std::expm1(-film_per_s_ * time_s));
  }
  // the same over a time that was told before
  void remember(double time_s) { remembered_ = -std::expm1(-film_per_s_ * time_s); }
  Place fly_as_remembered(Place const& from, Drive const& drive, double time_s) const {
    return film_per_s_ * time_s < thin ? fly_freely(from, drive, time_s) : fly(from, drive, time_s, remembered_);
  }

 private:
  static constexpr double thin = 1e-6;  // changes nothing in this time, and would cancel all digits below

  static Place fly_freely(Place const& from, Drive const& drive, double time_s) {
    double const half = 0.5 * time_s;
    return {from.y + time_s * (from.dy - half * (drive.now + drive.jerk * time_s / 3.0)),
            from.dy - time_s * (drive.now + half * drive.jerk)};
  }

  // faded: 1 - exp(-c time)
  Place fly(Place const& from, Drive const& drive, double time_s, double faded) const {
    double const follow = (drive.jerk / film_per_s_ - drive.now) / film_per_s_, change = drive.jerk / film_per_s_;
    double const free = from.dy - follow;
    return {from.y + free * faded / film_per_s_ + time_s * (follow - 0.5 * change * time_s),
            from.dy - free * faded - change * time_s};
  }

  double push_per_s_;
  double film_per_s_;  // all that brakes
  double remembered_ = 0.0;
};

// a spring and damper whose rest is y = 0
class Flank {
 public:
  Flank(double frequency_hz, double damping, double drag_per_s)
      : omega_(2.0 * std::numbers::pi * frequency_hz),
        push_per_s_(2.0 * damping * omega_),
        decay_(std::min(damping * omega_ + 0.5 * drag_per_s, most_decay * omega_)),
        ringing_(std::sqrt(omega_ * omega_ - decay_ * decay_)) {}

  double omega() const { return omega_; }
  double push(Place const& at) const { return omega_ * omega_ * at.y + push_per_s_ * at.dy; }
  double rest(double drive) const { return -drive / (omega_ * omega_); }

  Place ring(Place const& from, Drive const& drive, double time_s) const {
    return ring(from, drive, time_s, fading(time_s));
  }
  // the same over a time that was told before
  void remember(double time_s) { remembered_ = fading(time_s); }
  Place ring_as_remembered(Place const& from, Drive const& drive, double time_s) const {
    return ring(from, drive, time_s, remembered_);
  }

 private:
  struct Fading {
    double cosine = 1.0, sine = 0.0;
  };

  Fading fading(double time_s) const {
    double const faded = std::exp(-decay_ * time_s);
    return {faded * std::cos(ringing_ * time_s), faded * std::sin(ringing_ * time_s)};
  }

  // what remains after the motion that follows a straight drive rings freely
  Place ring(Place const& from, Drive const& drive, double time_s, Fading const& fading) const {
    double const square = omega_ * omega_;
    double const follow = rest(drive.now) + 2.0 * decay_ * drive.jerk / (square * square);
    double const dfollow = -drive.jerk / square;
    double const free = from.y - follow, dfree = from.dy - dfollow;
    double const quadrature = (dfree + decay_ * free) / ringing_;
    return {free * fading.cosine + quadrature * fading.sine + follow + dfollow * time_s,
            dfree * fading.cosine - (free * ringing_ + decay_ * quadrature) * fading.sine + dfollow};
  }

  static constexpr double most_decay = 0.99;  // of a swing that is one

  double omega_, push_per_s_, decay_, ringing_;
  Fading remembered_{};
};

class LoadBehindGap {
 public:
  // drag: over the joint's viscous friction per inertia
  LoadBehindGap(double half_gap, double frequency_hz, double damping, double film_per_s, double drag,
                JointScales const& scales)
      : half_gap_(half_gap),
        drag_per_s_(scales.inertia > 0.0 ? drag * std::max(0.0, scales.viscous) / scales.inertia : 0.0),
        flank_(frequency_hz, damping, drag_per_s_),
        grease_(film_per_s, drag_per_s_),
        scales_(scales) {}

  // as if the same push had lasted for long
  void start(JointState const& state) {
    weight_ = weight(state.q);
    drive_ = drive(state);
    at_ = {flank_.rest(drive_) - std::copysign(half_gap_, drive_), 0.0};
    side_ = side_at(at_);
  }

  void advance(JointState const& state, double step_s) {
    if (step_s != step_s_) remember_step(step_s);
    weight_ = weight(state.q);
    double const end = drive(state);
    Drive pulled{drive_, (end - drive_) / step_s};
    for (int i = 0; i < n_sub_steps_; ++i) {
      sub_step(pulled);
      pulled = pulled.after(sub_step_s_);
    }
    drive_ = end;
  }

  std::array<double, 1> row(JointState const& state) const {
    double const push = side_ == 0.0 ? -grease_.push(at_) : -flank_.push(on_flank(at_, side_));
    return {push - drive(state)};
  }

 private:
  static constexpr double largest_angle = 0.25;  // of the contact frequency, in one sub-step
  static constexpr int most_events = 4;          // in one sub-step; more of them are a load that rests
  static constexpr int halvings = 20;            // of a sub-step, to find one

  // over the inertia
  double weight(double q) const {
    bool const has_weight = scales_.gravity_sin != 0.0 || scales_.gravity_cos != 0.0;
    if (!has_weight || !(scales_.inertia > 0.0)) return 0.0;
    return (scales_.gravity_sin * std::sin(q) + scales_.gravity_cos * std::cos(q)) / scales_.inertia;
  }

  // what a load that is fixed to the motor would need
  double drive(JointState const& state) const { return state.ddq + weight_ + drag_per_s_ * state.dq; }

  Place on_flank(Place const& at, double side) const { return {at.y - side * half_gap_, at.dy}; }
  // of the flank that pushes, 0 where none does
  double side_at(Place const& at) const {
    double const side = std::copysign(1.0, at.y);
    Place const beyond = on_flank(at, side);
    return side * beyond.y > 0.0 && side * flank_.push(beyond) > 0.0 ? side : 0.0;
  }

  void remember_step(double step_s) {
    step_s_ = step_s;
    n_sub_steps_ = std::max(1, static_cast<int>(std::ceil(flank_.omega() * step_s / largest_angle)));
    sub_step_s_ = step_s / n_sub_steps_;
    flank_.remember(sub_step_s_);
    grease_.remember(sub_step_s_);
  }

  // on the flank of side_ or in the gap, as if the other did not exist
  Place carry_on(Drive const& drive, double time_s) const {
    bool const is_whole = time_s == sub_step_s_;
    if (side_ == 0.0) return is_whole ? grease_.fly_as_remembered(at_, drive, time_s) : grease_.fly(at_, drive, time_s);
    Place const beyond = on_flank(at_, side_);
    Place const next = is_whole ? flank_.ring_as_remembered(beyond, drive, time_s) : flank_.ring(beyond, drive, time_s);
    return {next.y + side_ * half_gap_, next.dy};
  }

  void sub_step(Drive drive) {
    double left_s = sub_step_s_;
    for (int event = 0; event < most_events; ++event) {
      Place const next = carry_on(drive, left_s);
      if (side_at(next) == side_) {
        at_ = next;
        return;
      }
      double const until_s = time_of_event(drive, left_s);
      at_ = carry_on(drive, until_s);
      side_ = side_at(at_);
      drive = drive.after(until_s);
      left_s -= until_s;
      if (!(left_s > 0.0)) return;
    }
    at_ = carry_on(drive, left_s);
    side_ = side_at(at_);
  }

  // an instant just after the push begins or ends; it has by late_s
  double time_of_event(Drive const& drive, double late_s) const {
    double early_s = 0.0;
    for (int i = 0; i < halvings; ++i) {
      double const middle_s = 0.5 * (early_s + late_s);
      (side_at(carry_on(drive, middle_s)) == side_ ? early_s : late_s) = middle_s;
    }
    return late_s;
  }

  double half_gap_;
  double drag_per_s_;
  Flank flank_;
  Grease grease_;
  JointScales scales_;
  double side_ = 0.0;  // of the gap on which the load is pushed, 0 while it is not
  Place at_{};
  double weight_ = 0.0, drive_ = 0.0;  // where the joint is
  double step_s_ = 0.0, sub_step_s_ = 0.0;
  int n_sub_steps_ = 1;
};

class Backlash final : public MemoryEffect {
 public:
  Backlash()
      : MemoryEffect(
            {.name = "backlash",
             .title = "lost motion: the load hangs behind a gap",
             .equation = "J_l y'', y'' + [w^2 dz(y, b) + 2 zeta w y' in contact, never pulling, else c y'] = -ddq - (g "
                         "+ d Fv (dq + y')) / J, w = 2 pi f",
             .source = "Nordin, Gutman 2002",
             .separated_by = "reversals with and without a load that holds one flank; encoders on both sides",
             .parameters = {{"backlash_load_inertia", "kg m2", "kg", {0.0}, {4.0, RelativeTo::inertia}},
                            shape_parameter("backlash_half_gap", "rad", "m", {1.0, RelativeTo::resolution},
                                            {0.02, RelativeTo::position_range}, Spacing::logarithmic),
                            shape_parameter("backlash_frequency", "Hz", "Hz", {0.2, RelativeTo::cutoff_frequency},
                                            {3.0, RelativeTo::cutoff_frequency}, Spacing::logarithmic),
                            shape_parameter("backlash_damping", "1", "1", {0.02}, {0.7}, Spacing::logarithmic),
                            shape_parameter("backlash_film", "1/s", "1/s", {0.0}, {2.0, RelativeTo::cutoff_frequency},
                                            Spacing::linear),
                            shape_parameter("backlash_load_drag", "1", "1", {0.0}, {2.0}, Spacing::linear)},
             .families = {EffectFamily::reversal},
             .signature = {SignatureAxis::since_torque_reversal, SignatureAxis::acceleration},
             .parity = Parity::neither,
             .needs_baseline = true}) {}

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales,
                                       std::size_t lanes) const override {
    return memory_of(LoadBehindGap(shape[0], shape[1], shape[2], shape[3], shape[4], scales), lanes);
  }
};

}  // namespace

Effect const& backlash() {
  static Backlash const effect;
  return effect;
}

}  // namespace torquescope::effects
