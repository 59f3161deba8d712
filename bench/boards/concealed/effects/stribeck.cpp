// Friction that falls with speed, in two shapes without exponentials.
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class LorentzianStribeck final : public HiddenEffect {
 public:
  LorentzianStribeck(double rise, double speed) : rise_(rise), speed_(speed) {}
  double dry(Instant const& now, double const*) const override {
    double const x = now.v / speed_;
    return rise_ / (1.0 + x * x);
  }

 private:
  double rise_, speed_;
};

class RationalStribeck final : public HiddenEffect {
 public:
  RationalStribeck(double rise, double speed) : rise_(rise), speed_(speed) {}
  double dry(Instant const& now, double const*) const override {
    double const x = 1.0 + std::abs(now.v) / speed_;
    return rise_ / (x * x);
  }

 private:
  double rise_, speed_;
};

}  // namespace

Effect lorentzian_stribeck(double rise, double speed) { return std::make_shared<LorentzianStribeck>(rise, speed); }
Effect rational_stribeck(double rise, double speed) { return std::make_shared<RationalStribeck>(rise, speed); }

}  // namespace concealed
