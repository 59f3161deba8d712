#pragma once
// The state of one load behind a gap whose flanks give way: effects/backlash.cpp has its equation.
//
// Memory     y and y', exact on a flank and in the gap for an acceleration that runs straight between two samples; the
//            instant of contact or release is searched within sub-steps of 1/4 rad of the contact frequency. The load's
//            dry friction is a part of what drives it while it slides; where it has come to rest by the end of a
//            sub-step it stays, while the motor moves on, until it is pushed by more
// Bits       loads_behind_gap.cpp writes whole sub-steps without an event a second time, operation by operation: change
//            both

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/effects/joint_states.hpp"
#include "engine/effects/remembered_steps.hpp"

namespace torquescope::load_behind_gap {

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
  Grease(double film_per_s, double drag_per_s)
      : push_per_s_(film_per_s), film_per_s_(film_per_s + drag_per_s), per_film_(1.0 / film_per_s_) {}

  double push(Place const& at) const { return push_per_s_ * at.dy; }

  Place fly(Place const& from, Drive const& drive, double time_s) const {
    return is_thin(time_s) ? fly_freely(from, drive, time_s) : fly_thickly(from, drive, time_s, faded(time_s));
  }
  // the same, with what was computed from the time before
  Place fly(Place const& from, Drive const& drive, double time_s, double faded) const {
    return is_thin(time_s) ? fly_freely(from, drive, time_s) : fly_thickly(from, drive, time_s, faded);
  }
  double faded(double time_s) const { return -std::expm1(-film_per_s_ * time_s); }
  // changes nothing in this time, and would cancel all digits
  bool is_thin(double time_s) const { return film_per_s_ * time_s < 1e-6; }
  double push_per_s() const { return push_per_s_; }
  double per_film() const { return per_film_; }  // infinite without any: thin

 private:
  static Place fly_freely(Place const& from, Drive const& drive, double time_s) {
    double const half = 0.5 * time_s;
    return {from.y + time_s * (from.dy - half * (drive.now + drive.jerk * time_s / 3.0)),
            from.dy - time_s * (drive.now + half * drive.jerk)};
  }

  // faded: 1 - exp(-c time)
  Place fly_thickly(Place const& from, Drive const& drive, double time_s, double faded) const {
    double const change = drive.jerk * per_film_, follow = (change - drive.now) * per_film_;
    double const free = from.dy - follow;
    return {from.y + free * faded * per_film_ + time_s * (follow - 0.5 * change * time_s),
            from.dy - free * faded - change * time_s};
  }

  double push_per_s_;
  double film_per_s_, per_film_;  // all that brakes
};

// of a swing over some time
struct Fading {
  double cosine = 1.0, sine = 0.0;
};

// a spring and damper whose rest is y = 0
class Flank {
 public:
  Flank(double frequency_hz, double damping, double drag_per_s)
      : omega_(2.0 * std::numbers::pi * frequency_hz),
        push_per_s_(2.0 * damping * omega_),
        decay_(std::min(damping * omega_ + 0.5 * drag_per_s, most_decay * omega_)),
        ringing_(std::sqrt(omega_ * omega_ - decay_ * decay_)),
        per_square_(1.0 / (omega_ * omega_)),
        lag_(2.0 * decay_ * per_square_ * per_square_),
        per_ringing_(1.0 / ringing_) {}

  double omega() const { return omega_; }
  double push_per_s() const { return push_per_s_; }
  double decay() const { return decay_; }
  double ringing() const { return ringing_; }
  double per_square() const { return per_square_; }    // 1 / omega^2
  double lag() const { return lag_; }                  // of what follows a drive, per jerk
  double per_ringing() const { return per_ringing_; }  // 1 / ringing
  double push(Place const& at) const { return omega_ * omega_ * at.y + push_per_s_ * at.dy; }
  double rest(double drive) const { return -drive * per_square_; }

  Place ring(Place const& from, Drive const& drive, double time_s) const {
    return ring(from, drive, time_s, fading(time_s));
  }
  Fading fading(double time_s) const {
    double const faded = std::exp(-decay_ * time_s);
    return {faded * std::cos(ringing_ * time_s), faded * std::sin(ringing_ * time_s)};
  }

  // what remains after the motion that follows a straight drive rings freely
  Place ring(Place const& from, Drive const& drive, double time_s, Fading const& fading) const {
    double const follow = rest(drive.now) + lag_ * drive.jerk;
    double const dfollow = rest(drive.jerk);
    double const free = from.y - follow, dfree = from.dy - dfollow;
    double const quadrature = (dfree + decay_ * free) * per_ringing_;
    return {free * fading.cosine + quadrature * fading.sine + follow + dfollow * time_s,
            dfree * fading.cosine - (free * ringing_ + decay_ * quadrature) * fading.sine + dfollow};
  }

 private:
  static constexpr double most_decay = 0.99;  // of a swing that is one

  double omega_, push_per_s_, decay_, ringing_;
  double per_square_, lag_, per_ringing_;  // a division takes as long as ten products
};

// the equal parts of a step, and what whole ones need to know
struct GapSubSteps {
  int count = 1;
  double time_s = 0.0;
  Fading fading{};     // on a flank
  double faded = 0.0;  // in the grease
};

// of one load
struct LoadState {
  Place at{};
  double side = 0.0;                           // of the gap on which the load is pushed, 0 while it is not
  double weight = 0.0, drive = 0.0, dq = 0.0;  // where the joint is
  double slides = 0.0;  // direction of the load's own motion, 0 at rest; without dry friction none
};

// of the load's own bearings, over its inertia; slides: -1, 1, or 0 at rest
struct DryFriction {
  double forward = 0.0, backward = 0.0;  // >= 0
  bool is_there() const { return forward > 0.0 || backward > 0.0; }
  double against(double slides) const { return slides > 0.0 ? forward : slides < 0.0 ? -backward : 0.0; }
  // of a load at rest that would be accelerated so
  double slides_under(double acceleration) const {
    double const held = acceleration > 0.0 ? forward : backward;
    return std::abs(acceleration) > held ? std::copysign(1.0, acceleration) : 0.0;
  }
};

class LoadBehindGap {
 public:
  // drag: over the joint's friction per inertia, viscous and dry
  LoadBehindGap(double half_gap, double frequency_hz, double damping, double film_per_s, double drag,
                JointScales const& scales)
      : half_gap_(half_gap),
        drag_per_s_(scales.inertia > 0.0 ? drag * std::max(0.0, scales.viscous) / scales.inertia : 0.0),
        dry_(dry_of(drag, scales)),
        flank_(frequency_hz, damping, drag_per_s_),
        grease_(film_per_s, drag_per_s_),
        scales_(scales) {}

  // as if the same push had lasted for long
  void start(JointState const& state) {
    load_.weight = weight(state.q);
    load_.drive = drive(state);
    load_.dq = state.dq;
    double const whole = load_.drive + dry_.against(state.dq);
    load_.slides = state.dq > 0.0 ? 1.0 : state.dq < 0.0 ? -1.0 : 0.0;
    load_.at = {flank_.rest(whole) - std::copysign(half_gap_, whole), 0.0};
    load_.side = side_at(load_.at);
  }

  void advance(JointState const& state, double step_s) {
    divide(step_s);
    load_.weight = weight(state.q);
    double const end = drive(state);
    Drive pulled{load_.drive, (end - load_.drive) / step_s};
    double const faster = (state.dq - load_.dq) / sub_steps_.count;
    for (int i = 0; i < sub_steps_.count; ++i) {
      if (dry_.is_there())
        dry_sub_step(pulled, faster);
      else
        sub_step(pulled);
      pulled = pulled.after(sub_steps_.time_s);
      load_.dq += faster;
    }
    load_.drive = end;
    load_.dq = state.dq;
  }

  // steps from now on last step_s
  void divide(double step_s) {
    if (step_s == step_s_) return;
    step_s_ = step_s;
    sub_steps_ = remembered_.of(step_s, [this](double whole_s) { return sub_steps_in(whole_s); });
  }

  // one part of a step, whatever happens in it
  void sub_step(Drive drive) {
    double left_s = sub_steps_.time_s;
    for (int event = 0; event < most_events; ++event) {
      Place const next = carry_on(drive, left_s);
      if (side_at(next) == load_.side) {
        load_.at = next;
        return;
      }
      double const until_s = time_of_event(drive, left_s);
      load_.at = carry_on(drive, until_s);
      load_.side = side_at(load_.at);
      drive = drive.after(until_s);
      left_s -= until_s;
      if (!(left_s > 0.0)) return;
    }
    load_.at = carry_on(drive, left_s);
    load_.side = side_at(load_.at);
  }

  // the same of a load with dry friction; faster: what the joint gains in it
  void dry_sub_step(Drive const& drive, double faster) {
    double const y = load_.at.y, per_step = 1.0 / sub_steps_.time_s;
    if (load_.slides == 0.0)
      load_.slides =
          dry_.slides_under(push(load_.at, load_.side) - (drive.now - faster * per_step - drag_per_s_ * load_.dq));
    sub_step({drive.now + dry_.against(load_.slides), drive.jerk});
    double const next_dq = load_.dq + faster;
    bool const rests = load_.slides == 0.0;
    if (rests) load_.at.y = y - sub_steps_.time_s * (load_.dq + 0.5 * faster);
    if (!rests && (next_dq + load_.at.dy) * load_.slides > 0.0) return;
    load_.slides = 0.0;
    load_.at.dy = -next_dq;
    load_.side = side_at(load_.at);
  }
  DryFriction const& dry() const { return dry_; }

  // what a load that is fixed to the motor would need, but for its dry friction
  double drive(JointState const& state) const { return drive_of(state, load_.weight); }
  double drive_of(JointState const& state, double weight) const { return state.ddq + weight + drag_per_s_ * state.dq; }
  bool has_weight() const {
    return (scales_.gravity_sin != 0.0 || scales_.gravity_cos != 0.0) && scales_.inertia > 0.0;
  }
  // over the inertia
  double weight(double cosine, double sine) const {
    return (scales_.gravity_sin * sine + scales_.gravity_cos * cosine) / scales_.inertia;
  }
  double weight(double q) const {
    if (!has_weight()) return 0.0;
    double cosine = 1.0, sine = 0.0;
    kernels::cosine_sine_of_multiple(1.0, &q, 1, &cosine, &sine);
    return weight(cosine, sine);
  }

  // of the joint on the load
  double push(Place const& at, double side) const {
    return side == 0.0 ? -grease_.push(at) : -flank_.push(on_flank(at, side));
  }

  LoadState const& load() const { return load_; }
  void put(LoadState const& load) { load_ = load; }
  double half_gap() const { return half_gap_; }
  double drag_per_s() const { return drag_per_s_; }
  Flank const& flank() const { return flank_; }
  Grease const& grease() const { return grease_; }
  GapSubSteps const& sub_steps() const { return sub_steps_; }

  std::array<double, 1> row(JointState const& state) const {
    return {push(load_.at, load_.side) - (drive(state) + dry_.against(state.dq))};
  }

 private:
  static constexpr double largest_angle = 0.25;     // of the contact frequency, in one sub-step
  static constexpr double largest_dry_angle = 0.1;  // a load comes to rest at the end of one
  static constexpr int most_events = 4;             // in one sub-step; more of them are a load that rests
  static constexpr int halvings = 20;               // of a sub-step, to find one

  static DryFriction dry_of(double drag, JointScales const& scales) {
    if (!(scales.inertia > 0.0)) return {};
    double const share = drag / scales.inertia;
    return {share * std::max(0.0, scales.coulomb_positive), share * std::max(0.0, scales.coulomb_negative)};
  }

  Place on_flank(Place const& at, double side) const { return {at.y - side * half_gap_, at.dy}; }
  // of the flank that pushes, 0 where none does
  double side_at(Place const& at) const {
    double const side = std::copysign(1.0, at.y);
    Place const beyond = on_flank(at, side);
    return side * beyond.y > 0.0 && side * flank_.push(beyond) > 0.0 ? side : 0.0;
  }

  GapSubSteps sub_steps_in(double step_s) const {
    double const angle = dry_.is_there() ? largest_dry_angle : largest_angle;
    int const count = std::max(1, static_cast<int>(std::ceil(flank_.omega() * step_s / angle)));
    double const time_s = step_s / count;
    return {count, time_s, flank_.fading(time_s), grease_.faded(time_s)};
  }

  // on the flank of load_.side or in the gap, as if the other did not exist
  Place carry_on(Drive const& drive, double time_s) const {
    bool const is_whole = time_s == sub_steps_.time_s;
    if (load_.side == 0.0)
      return is_whole ? grease_.fly(load_.at, drive, time_s, sub_steps_.faded) : grease_.fly(load_.at, drive, time_s);
    Place const beyond = on_flank(load_.at, load_.side);
    Place const next =
        is_whole ? flank_.ring(beyond, drive, time_s, sub_steps_.fading) : flank_.ring(beyond, drive, time_s);
    return {next.y + load_.side * half_gap_, next.dy};
  }

  // an instant just after the push begins or ends; it has by late_s
  double time_of_event(Drive const& drive, double late_s) const {
    double early_s = 0.0;
    for (int i = 0; i < halvings; ++i) {
      double const middle_s = 0.5 * (early_s + late_s);
      (side_at(carry_on(drive, middle_s)) == load_.side ? early_s : late_s) = middle_s;
    }
    return late_s;
  }

  double half_gap_;
  double drag_per_s_;
  DryFriction dry_;
  Flank flank_;
  Grease grease_;
  JointScales scales_;
  LoadState load_{};
  double step_s_ = 0.0;
  GapSubSteps sub_steps_{};  // of that step
  RememberedSteps<GapSubSteps> remembered_{};
};

}  // namespace torquescope::load_behind_gap
