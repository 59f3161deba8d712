#include "concealed/plant.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace concealed {
namespace {

constexpr int max_iterations = 60;

int sign_of(double v) { return v > 0.0 ? 1 : v < 0.0 ? -1 : 0; }

Instant at(double t, Vector const& y, int direction, Drive const& drive) {
  return {t, y[0], y[1], 0.0, direction, drive.motor};
}

}  // namespace

Plant::Plant(Baseline const& baseline, HiddenEffects effects)
    : baseline_(baseline), effects_(std::move(effects)), motor_inertia_(baseline.inertia) {
  for (auto const& effect : effects_) {
    first_state_.push_back(n_states_);
    n_states_ += effect->n_states();
    motor_inertia_ -= effect->moved_inertia();
    feels_load_ = feels_load_ || effect->feels_load();
  }
  if (baseline_.sticking.kind == Sticking::bristle) ++n_states_;
  if (n_states_ > max_states) throw std::invalid_argument("the effects have more states than max_states");
}

State Plant::at_rest(double q) const {
  State state;
  state.y[0] = q;
  for (std::size_t i = 0; i < effects_.size(); ++i) effects_[i]->start(q, state.y.data() + first_state_[i]);
  return state;
}

double Plant::known_torque(Instant const& now) const {
  double torque = baseline_.offset + baseline_.viscous * now.v;
  if (baseline_.has_gravity()) {
    torque += baseline_.gravity_sin * std::sin(now.q) + baseline_.gravity_cos * std::cos(now.q);
  }
  return torque;
}

double Plant::smooth_torque(Instant const& now, Vector const& y) const {
  double torque = known_torque(now);
  for (std::size_t i = 0; i < effects_.size(); ++i) torque += effects_[i]->torque(now, y.data() + first_state_[i]);
  return torque;
}

double Plant::dry_level(Instant const& now, Vector const& y, Drive const& drive) const {
  double level = drive.coulomb_factor * baseline_.coulomb;
  for (std::size_t i = 0; i < effects_.size(); ++i) level += effects_[i]->dry(now, y.data() + first_state_[i]);
  return std::max(0.0, level);
}

int Plant::direction(State const& state, Drive const& drive) const {
  StickingLaw const& law = baseline_.sticking;
  bool const slow = law.kind == Sticking::band && std::abs(state.v()) < law.speed;
  if (law.is_smooth() || (state.v() != 0.0 && !slow)) return sign_of(state.v());
  double const push = drive.total() - smooth_torque(at(state.t, state.y, 0, drive), state.y);
  int const wanted = push > 0.0 ? 1 : -1;
  double const hold = dry_level(at(state.t, state.y, wanted, drive), state.y, drive);
  if (std::abs(push) <= hold) return 0;
  return state.v() != 0.0 ? sign_of(state.v()) : wanted;
}

double Plant::bending_speed(Instant const& now, Vector const& y) const {
  return now.v - std::abs(now.v) * y[n_states_ - 1] / baseline_.sticking.length;
}

double Plant::share(Instant const& now, Vector const& y, double level) const {
  StickingLaw const& law = baseline_.sticking;
  if (law.kind == Sticking::creep) return std::clamp(now.v / law.speed, -1.0, 1.0);
  if (law.kind != Sticking::bristle || !(level > 0.0)) return now.direction;
  constexpr double of_critical = 0.1;
  double const damping = of_critical * 2.0 * std::sqrt(level / law.length * baseline_.inertia);
  return y[n_states_ - 1] / law.length + damping / level * bending_speed(now, y);
}

double Plant::sliding_acceleration(Instant const& now, Vector const& y, Drive const& drive) const {
  double const push = drive.total() - smooth_torque(now, y);
  double inertia = motor_inertia_;
  for (auto const& effect : effects_) inertia += effect->added_inertia(now);
  auto answer = [&](double a) {
    Instant loaded = now;
    loaded.a = a;
    double const level = dry_level(loaded, y, drive);
    return (push - share(now, y, level) * level) / inertia;
  };
  double a = answer(0.0);
  if (!feels_load_) return a;

  // secant on a - answer(a): friction takes only a part of the load back, so the root is unique and near
  double last = a, last_error = last - answer(last);
  a = last - last_error;
  for (int i = 0; i < max_iterations; ++i) {
    double const error = a - answer(a);
    if (std::abs(error) <= 1e-14 * std::abs(a) || error == last_error) break;
    double const next = a - error * (a - last) / (error - last_error);
    last = a;
    last_error = error;
    a = next;
  }
  return a;
}

double Plant::acceleration(State const& state, Drive const& drive) const {
  int const branch = direction(state, drive);
  if (branch == 0 && !baseline_.sticking.is_smooth()) return 0.0;
  return sliding_acceleration(at(state.t, state.y, branch, drive), state.y, drive);
}

double Plant::added_torque(std::size_t index, State const& state, Drive const& drive) const {
  HiddenEffect const& effect = *effects_[index];
  double const* z = state.y.data() + first_state_[index];
  Instant now = at(state.t, state.y, direction(state, drive), drive);
  now.a = acceleration(state, drive);
  return effect.torque(now, z) + share(now, state.y, dry_level(now, state.y, drive)) * effect.dry(now, z) +
         (effect.added_inertia(now) - effect.moved_inertia()) * now.a;
}

void Plant::derivative(double t, Vector const& y, int direction, Drive const& drive, Vector& dy) const {
  bool const smooth = baseline_.sticking.is_smooth();
  Instant const now = at(t, y, smooth ? sign_of(y[1]) : direction, drive);
  dy[0] = y[1];
  dy[1] = direction == 0 && !smooth ? 0.0 : sliding_acceleration(now, y, drive);
  if (baseline_.sticking.kind == Sticking::bristle) dy[n_states_ - 1] = bending_speed(now, y);
  for (std::size_t i = 0; i < effects_.size(); ++i)
    effects_[i]->rates(now, y.data() + first_state_[i], dy.data() + first_state_[i]);
}

Vector Plant::step(State const& state, int direction, Drive const& drive, double h) const {
  // start, twice the middle, end: each slope taken where the one before leads
  Vector slope{}, between = state.y, next = state.y;
  double const place[4] = {0.0, 0.5, 0.5, 1.0};
  double const weight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  for (int stage = 0; stage < 4; ++stage) {
    for (std::size_t i = 0; i < n_states_; ++i) between[i] = state.y[i] + place[stage] * h * slope[i];
    derivative(state.t + place[stage] * h, between, direction, drive, slope);
    for (std::size_t i = 0; i < n_states_; ++i) next[i] += weight[stage] * h * slope[i];
  }
  return next;
}

double Plant::slide_to_rest(State& state, int direction, Drive const& drive, double step_s, double v_end) const {
  // Illinois variant of regula falsi on the length of the step
  double low = 0.0, high = step_s, v_low = state.v(), v_high = v_end, cut = step_s;
  Vector next{};
  int side = 0;
  for (int i = 0; i < max_iterations && high - low > 1e-9 * step_s; ++i) {
    cut = (v_high * low - v_low * high) / (v_high - v_low);
    next = step(state, direction, drive, cut);
    if (next[1] == 0.0) break;
    if (next[1] * direction > 0.0) {
      low = cut;
      v_low = next[1];
      if (side == 1) v_high *= 0.5;
      side = 1;
    } else {
      high = cut;
      v_high = next[1];
      if (side == -1) v_low *= 0.5;
      side = -1;
    }
  }
  state.y = next;
  state.y[1] = 0.0;
  state.t += cut;
  return cut;
}

double Plant::stiffness(State const& state, Drive const& drive, double step_s) const {
  StickingLaw const& law = baseline_.sticking;
  Instant const now = at(state.t, state.y, sign_of(state.v()), drive);
  double const level = dry_level(now, state.y, drive);
  if (law.kind == Sticking::bristle)
    return std::max(std::abs(state.v()) / law.length, 2.0 * std::sqrt(level / law.length / baseline_.inertia));
  double const nearest = std::abs(state.v()) - std::abs(acceleration(state, drive)) * step_s;
  return nearest < law.speed ? level / law.speed / baseline_.inertia : 0.0;
}

void Plant::advance_smoothly(State& state, Drive const& drive, double step_s) const {
  auto const parts = static_cast<int>(std::ceil(std::max(1.0, stiffness(state, drive, step_s) * step_s)));
  for (int i = 0; i < parts; ++i) {
    state.y = step(state, 0, drive, step_s / parts);
    state.t += step_s / parts;
  }
}

void Plant::advance(State& state, Drive const& drive, double step_s) const {
  if (baseline_.sticking.is_smooth()) {
    double const after = state.t + step_s;
    advance_smoothly(state, drive, step_s);
    state.t = after;
    return;
  }
  double const end = state.t + step_s;
  double left = step_s;
  while (left > 0.0) {
    int const branch = direction(state, drive);
    if (branch == 0) state.y[1] = 0.0;
    Vector next = step(state, branch, drive, left);
    if (branch * next[1] < 0.0) {
      if (state.v() != 0.0) {
        left -= slide_to_rest(state, branch, drive, left, next[1]);
        continue;
      }
      // pushed off and back within one step: friction holds it
      next = step(state, 0, drive, left);
    }
    state.y = next;
    break;
  }
  state.t = end;
}

}  // namespace concealed
