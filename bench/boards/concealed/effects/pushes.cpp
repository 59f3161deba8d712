// Torques from outside: one push that comes fast and fades slowly, and a machine nearby that hums.
#include <cmath>
#include <numbers>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class Push final : public HiddenEffect {
 public:
  Push(double peak, double start_s, double rise_s) : peak_(peak), start_s_(start_s), rise_s_(rise_s) {}
  double torque(Instant const& now, double const*) const override {
    double const x = (now.t - start_s_) / rise_s_;
    return x > 0.0 ? peak_ * x * x * std::exp(2.0 * (1.0 - x)) : 0.0;
  }

 private:
  double peak_, start_s_, rise_s_;
};

class Hum final : public HiddenEffect {
 public:
  Hum(double amplitude, double frequency_hz, double phase)
      : amplitude_(amplitude), omega_(2.0 * std::numbers::pi * frequency_hz), phase_(phase) {}
  double torque(Instant const& now, double const*) const override {
    return amplitude_ * std::sin(omega_ * now.t + phase_);
  }

 private:
  double amplitude_, omega_, phase_;
};

}  // namespace

Effect push(double peak, double start_s, double rise_s) { return std::make_shared<Push>(peak, start_s, rise_s); }
Effect hum(double amplitude, double frequency_hz, double phase) {
  return std::make_shared<Hum>(amplitude, frequency_hz, phase);
}

}  // namespace concealed
