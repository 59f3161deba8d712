// A lubricant film that needs time to build up and another time to be squeezed out, so that friction follows the speed
// late.
//
// State      w, the speed that the film is made for
// Equation   dw/dt = (|v| - w) / tau, tau = thicken while w < |v|, thin otherwise; tau = s rise (g(w) - g(|v|)),
//            g(v) = 1 / (1 + v / speed)^2
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class LaggingFriction final : public HiddenEffect {
 public:
  LaggingFriction(double rise, double speed, double thicken_s, double thin_s)
      : rise_(rise), speed_(speed), thicken_s_(thicken_s), thin_s_(thin_s) {}
  std::size_t n_states() const override { return 1; }
  void rates(Instant const& now, double const* z, double* dz) const override {
    double const ahead = std::abs(now.v) - z[0];
    dz[0] = ahead / (ahead > 0.0 ? thicken_s_ : thin_s_);
  }
  double dry(Instant const& now, double const* z) const override { return rise_ * (level(z[0]) - level(now.v)); }

 private:
  double level(double v) const {
    double const x = 1.0 + std::abs(v) / speed_;
    return 1.0 / (x * x);
  }

  double rise_, speed_, thicken_s_, thin_s_;
};

}  // namespace

Effect lagging_friction(double rise, double speed, double thicken_s, double thin_s) {
  return std::make_shared<LaggingFriction>(rise, speed, thicken_s, thin_s);
}

}  // namespace concealed
