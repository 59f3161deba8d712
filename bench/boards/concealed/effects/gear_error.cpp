// Teeth that are not where they should be: the link stands at q + h(q), rigidly.
//
// Equation   h = amplitude (sin x + 0.35 sin(2 x + 0.9)), x = order q + phase; with k = 1 + h' the motor delivers
//            inertia (k^2 a + k h'' v^2) + viscous k^2 v + k gravity(q + h) for the link in place of
//            inertia a + viscous v + gravity(q): the difference is the effect (exact kinematics, no small-error series)
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class GearError final : public HiddenEffect {
 public:
  GearError(double amplitude, double order, double phase, double link_viscous, Link const& link)
      : amplitude_(amplitude), order_(order), phase_(phase), viscous_(link_viscous), link_(link) {}
  double torque(Instant const& now, double const*) const override {
    auto const [h, slope, bend] = error(now.q);
    double const k = 1.0 + slope;
    return link_.inertia * k * bend * now.v * now.v + viscous_ * slope * (1.0 + k) * now.v +
           k * link_.weight(now.q + h) - link_.weight(now.q);
  }
  double added_inertia(Instant const& now) const override {
    double const slope = error(now.q).slope;
    return link_.inertia * slope * (2.0 + slope);
  }

 private:
  struct Error {
    double h, slope, bend;
  };
  Error error(double q) const {
    double const x = order_ * q + phase_, y = 2.0 * x + 0.9;
    return {amplitude_ * (std::sin(x) + 0.35 * std::sin(y)), amplitude_ * order_ * (std::cos(x) + 0.7 * std::cos(y)),
            -amplitude_ * order_ * order_ * (std::sin(x) + 1.4 * std::sin(y))};
  }
  double amplitude_, order_, phase_, viscous_;
  Link link_;
};

}  // namespace

Effect gear_error(double amplitude, double order, double phase, double link_viscous, Link const& link) {
  return std::make_shared<GearError>(amplitude, order, phase, link_viscous, link);
}

}  // namespace concealed
