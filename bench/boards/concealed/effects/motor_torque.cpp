// A motor that does not give the torque its current stands for: windings that wave with the angle, iron that saturates.
//
// Equation   the drive records motor, the joint gets less or more; torque() is what is missing of it
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class TorqueRipple final : public HiddenEffect {
 public:
  TorqueRipple(double share, double order, double phase) : share_(share), order_(order), phase_(phase) {}
  double torque(Instant const& now, double const*) const override {
    double const x = order_ * now.q + phase_;
    return now.motor * share_ * (std::sin(x) + 0.3 * std::sin(2.0 * x + 0.5));
  }

 private:
  double share_, order_, phase_;
};

class Saturation final : public HiddenEffect {
 public:
  explicit Saturation(double knee) : knee_(knee) {}
  double torque(Instant const& now, double const*) const override {
    double const x = now.motor / knee_;
    return now.motor * (1.0 - 1.0 / std::sqrt(1.0 + x * x));
  }

 private:
  double knee_;
};

}  // namespace

Effect torque_ripple(double share, double order, double phase) {
  return std::make_shared<TorqueRipple>(share, order, phase);
}
Effect saturation(double knee) { return std::make_shared<Saturation>(knee); }

}  // namespace concealed
