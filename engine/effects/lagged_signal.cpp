#include "engine/effects/lagged_signal.hpp"

namespace torquescope {

void LaggedSignal::start(double time_s, double value) {
  samples_.assign(1, {time_s, value});
  lagged_ = value;
}

void LaggedSignal::push(double time_s, double value) {
  samples_.push_back({time_s, value});

  // keep one sample at or before the wanted instant
  double const wanted_s = time_s - lag_s_;
  while (samples_.size() > 2 && samples_[1].time_s <= wanted_s) samples_.pop_front();

  auto const& before = samples_[0];
  auto const& after = samples_[1];
  double const share = (wanted_s - before.time_s) / (after.time_s - before.time_s);
  lagged_ = share <= 0.0 ? before.value : before.value + share * (after.value - before.value);
}

}  // namespace torquescope
