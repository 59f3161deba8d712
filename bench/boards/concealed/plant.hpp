#pragma once
// One joint: baseline (inertia, viscous, Coulomb, offset, known gravity) and hidden effects, with dry friction that can
// hold it at rest, by any of the laws of sticking_law.hpp.
//
// Method     classical Runge-Kutta of fourth order on each smooth branch; where the velocity meets zero the step is cut
//            there (regula falsi), then the joint rests or leaves on the other branch
// Accuracy   fourth order between events; resting joints are asked for release at step boundaries (second order)
// Units      SI of the joint: N m, rad or N, m
// Errors     std::invalid_argument: more effect states than max_states has room for
// Threads    const object, any number of threads

#include <array>
#include <string>
#include <vector>

#include "concealed/hidden_effect.hpp"
#include "concealed/sticking_law.hpp"

namespace concealed {

// tau = inertia a + viscous v + coulomb sign(v) + offset + gravity_sin sin q + gravity_cos cos q
struct Baseline {
  double inertia = 0.0, viscous = 0.0, coulomb = 0.0, offset = 0.0;
  double gravity_sin = 0.0, gravity_cos = 0.0;
  StickingLaw sticking{};
  bool has_gravity() const { return gravity_sin != 0.0 || gravity_cos != 0.0; }
};

// what acts on the joint during one tick
struct Drive {
  double motor = 0.0;           // held torque of the motor
  double disturbance = 0.0;     // torque from outside
  double coulomb_factor = 1.0;  // slow wander of the friction level
  double total() const { return motor + disturbance; }
};

// position, velocity, the states of the effects one after the other, then the bend of bristles
inline constexpr std::size_t max_states = 18;
using Vector = std::array<double, max_states>;

struct State {
  double t = 0.0;
  Vector y{};
  double q() const { return y[0]; }
  double v() const { return y[1]; }
};

class Plant {
 public:
  Plant(Baseline const& baseline, HiddenEffects effects);

  Baseline const& baseline() const { return baseline_; }
  std::size_t n_effects() const { return effects_.size(); }

  State at_rest(double q) const;
  void advance(State& state, Drive const& drive, double step_s) const;

  int direction(State const& state, Drive const& drive) const;  // -1, 1; 0: held by dry friction
  double acceleration(State const& state, Drive const& drive) const;
  // what effect `index` adds to the torque of the baseline at this instant
  double added_torque(std::size_t index, State const& state, Drive const& drive) const;

 private:
  double known_torque(Instant const& now) const;  // baseline without inertia and dry friction
  double smooth_torque(Instant const& now, Vector const& y) const;
  double dry_level(Instant const& now, Vector const& y, Drive const& drive) const;
  // of the dry friction: 1 while sliding forwards
  double share(Instant const& now, Vector const& y, double level) const;
  double bending_speed(Instant const& now, Vector const& y) const;
  double sliding_acceleration(Instant const& now, Vector const& y, Drive const& drive) const;
  void derivative(double t, Vector const& y, int direction, Drive const& drive, Vector& dy) const;
  void advance_smoothly(State& state, Drive const& drive, double step_s) const;
  // per second, of the fastest part that a sticking law adds
  double stiffness(State const& state, Drive const& drive, double step_s) const;
  Vector step(State const& state, int direction, Drive const& drive, double step_s) const;
  // cuts a step that ends at v_end, beyond zero, where the velocity is zero; returns the time used
  double slide_to_rest(State& state, int direction, Drive const& drive, double step_s, double v_end) const;

  Baseline baseline_;
  HiddenEffects effects_;
  std::vector<std::size_t> first_state_;  // of each effect in y
  std::size_t n_states_ = 2;
  double motor_inertia_ = 0.0;
  bool feels_load_ = false;
};

}  // namespace concealed
