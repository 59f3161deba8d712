#pragma once
// Hidden effects put through imposed and free motions, for tests of their laws.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "concealed/effects/laws.hpp"
#include "concealed/plant.hpp"

namespace concealed {

inline constexpr double law_step_s = 20e-6;

// work an effect takes from a motion that is imposed on it: q = reach sin(2 pi t / period)
inline double work_over(HiddenEffect const& effect, double reach, double period_s, double from_turn, double to_turn) {
  double const omega = 2.0 * std::numbers::pi / period_s;
  auto at = [&](double t) {
    double const v = reach * omega * std::cos(omega * t);
    return Instant{t, reach * std::sin(omega * t), v, -reach * omega * omega * std::sin(omega * t), v > 0.0 ? 1 : -1};
  };
  std::vector<double> z(effect.n_states() + 1), rates(effect.n_states() + 1), half(effect.n_states() + 1);
  effect.start(0.0, z.data());
  double work = 0.0;
  for (long i = 0; i < std::lround(to_turn * period_s / law_step_s); ++i) {
    double const t = static_cast<double>(i) * law_step_s;
    Instant const middle = at(t + 0.5 * law_step_s);
    effect.rates(at(t), z.data(), rates.data());
    for (std::size_t j = 0; j < z.size(); ++j) half[j] = z[j] + 0.5 * law_step_s * rates[j];
    double const torque = effect.torque(middle, half.data()) + middle.direction * effect.dry(middle, half.data());
    if (t >= from_turn * period_s) work += torque * middle.v * law_step_s;
    effect.rates(middle, half.data(), rates.data());
    for (std::size_t j = 0; j < z.size(); ++j) z[j] += law_step_s * rates[j];
  }
  return work;
}

// largest change of (kinetic + potential energy) of a joint without friction, as share of its start
inline double energy_drift(Effect const& effect, double inertia, std::function<double(State const&)> const& potential) {
  Baseline baseline;
  baseline.inertia = inertia;
  Plant const plant(baseline, {effect});
  State state = plant.at_rest(0.0);
  state.y[1] = 1.3;
  double const motor = inertia - effect->moved_inertia();
  auto energy = [&] { return 0.5 * motor * state.v() * state.v() + potential(state); };
  double const start = energy();
  double drift = 0.0;
  for (int i = 0; i < 100000; ++i) {
    plant.advance(state, {}, law_step_s);
    drift = std::max(drift, std::abs(energy() / start - 1.0));
  }
  return drift;
}

}  // namespace concealed
