#include "engine/simulate/sampled_reference.hpp"

#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

// value, slope and curvature at both ends of [0, 1]; at x, per unit of x
ReferencePoint hermite(ReferencePoint const& a, ReferencePoint const& b, double x) {
  // a.q + a.dq x + a.ddq x^2 / 2 leaves these for x^3, x^4, x^5
  double const value = b.q - (a.q + a.dq + 0.5 * a.ddq);
  double const slope = b.dq - (a.dq + a.ddq);
  double const bend = b.ddq - a.ddq;
  double const c3 = 10.0 * value - 4.0 * slope + 0.5 * bend;
  double const c4 = -15.0 * value + 7.0 * slope - bend;
  double const c5 = 6.0 * value - 3.0 * slope + 0.5 * bend;
  return {a.q + x * (a.dq + x * (0.5 * a.ddq + x * (c3 + x * (c4 + x * c5)))),
          a.dq + x * (a.ddq + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5))),
          a.ddq + x * (6.0 * c3 + x * (12.0 * c4 + x * 20.0 * c5))};
}

class Sampled final : public Reference {
 public:
  explicit Sampled(SampledMotion motion) : motion_(std::move(motion)) {}

  ReferencePoint at(double time_s) const override {
    double const h = motion_.step_s;
    auto const pieces = static_cast<double>(motion_.q.size() - 1);
    double const place = std::fmod(time_s / h, pieces), whole = std::floor(place);
    auto const i = static_cast<Eigen::Index>(whole);
    ReferencePoint const here = hermite(scaled(i), scaled(i + 1), place - whole);
    return {here.q, here.dq / h, here.ddq / (h * h)};
  }

 private:
  ReferencePoint scaled(Eigen::Index i) const {
    double const h = motion_.step_s;
    return {motion_.q[i], motion_.dq[i] * h, motion_.ddq[i] * h * h};
  }
  SampledMotion motion_;
};

}  // namespace

std::unique_ptr<Reference const> sampled_reference(SampledMotion motion) {
  TORQUESCOPE_EXPECT(motion.step_s > 0.0 && motion.q.size() >= 2);
  TORQUESCOPE_EXPECT(motion.dq.size() == motion.q.size() && motion.ddq.size() == motion.q.size());
  return std::make_unique<Sampled>(std::move(motion));
}

}  // namespace torquescope
