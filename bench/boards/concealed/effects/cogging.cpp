// Magnets and teeth: a torque locked to the angle, with two overtones.
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class Cogging final : public HiddenEffect {
 public:
  Cogging(double amplitude, double order, double phase) : amplitude_(amplitude), order_(order), phase_(phase) {}
  double torque(Instant const& now, double const*) const override {
    double const x = order_ * now.q + phase_;
    return amplitude_ * (std::sin(x) + 0.45 * std::sin(2.0 * x + 0.7) + 0.25 * std::sin(3.0 * x + 2.1));
  }

 private:
  double amplitude_, order_, phase_;
};

}  // namespace

Effect cogging(double amplitude, double order, double phase) {
  return std::make_shared<Cogging>(amplitude, order, phase);
}

}  // namespace concealed
