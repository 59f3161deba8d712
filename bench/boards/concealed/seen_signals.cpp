#include "concealed/seen_signals.hpp"

#include <cmath>

namespace concealed {

SeenSignals::SeenSignals(Instruments const& instruments) : instruments_(instruments), change_(instruments.size(), 0.0) {
  for (auto const& instrument : instruments_) memory_.emplace_back(instrument->n_memory(), 0.0);
}

double SeenSignals::torque(double t, double motor) {
  double seen = motor;
  for (std::size_t i = 0; i < instruments_.size(); ++i) {
    double const next = instruments_[i]->torque(t, seen, memory_[i].data());
    change_[i] = next - seen;
    seen = next;
  }
  return seen;
}

double SeenSignals::position(double q) const {
  double seen = q;
  for (auto const& instrument : instruments_) seen += instrument->position(q).error;
  return seen;
}

SeenSignals::Motion SeenSignals::shifted(Motion const& truth, PositionError const& error) {
  return {truth.q + error.error, truth.v * (1.0 + error.slope),
          truth.a * (1.0 + error.slope) + error.bend * truth.v * truth.v};
}

SeenSignals::Motion SeenSignals::motion(Motion const& truth) const {
  PositionError sum;
  for (auto const& instrument : instruments_) {
    PositionError const one = instrument->position(truth.q);
    sum.error += one.error;
    sum.slope += one.slope;
    sum.bend += one.bend;
  }
  return shifted(truth, sum);
}

double SeenSignals::faked(std::size_t index, Baseline const& baseline, Motion const& truth) const {
  Motion const seen = shifted(truth, instruments_[index]->position(truth.q));
  return change_[index] + baseline.inertia * (truth.a - seen.a) + baseline.viscous * (truth.v - seen.v) +
         baseline.gravity_sin * (std::sin(truth.q) - std::sin(seen.q)) +
         baseline.gravity_cos * (std::cos(truth.q) - std::cos(seen.q));
}

}  // namespace concealed
