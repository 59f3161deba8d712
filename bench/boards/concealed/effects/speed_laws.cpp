// Smooth friction that depends on the speed alone: drag of air and churned oil, grease that thins under shear.
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class SpeedDrag final : public HiddenEffect {
 public:
  explicit SpeedDrag(double quadratic) : quadratic_(quadratic) {}
  double torque(Instant const& now, double const*) const override { return quadratic_ * now.v * std::abs(now.v); }

 private:
  double quadratic_;
};

class ShearThinning final : public HiddenEffect {
 public:
  ShearThinning(double viscous, double knee, double exponent)
      : viscous_(viscous), knee_(knee), power_(0.5 * (exponent - 1.0)) {}
  double torque(Instant const& now, double const*) const override {
    double const x = now.v / knee_;
    return viscous_ * now.v * std::pow(1.0 + x * x, power_);
  }

 private:
  double viscous_, knee_, power_;
};

}  // namespace

Effect speed_drag(double quadratic) { return std::make_shared<SpeedDrag>(quadratic); }
Effect shear_thinning(double viscous, double knee, double exponent) {
  return std::make_shared<ShearThinning>(viscous, knee, exponent);
}

}  // namespace concealed
