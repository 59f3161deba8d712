// Surfaces that bond while they rest and tear apart over a distance.
//
// State      age of the bond, s: grows at rest, d age/dt = -|v| age / distance in motion
// Equation   s rise ln(1 + age / onset)
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class RestingBond final : public HiddenEffect {
 public:
  RestingBond(double rise, double onset_s, double distance) : rise_(rise), onset_s_(onset_s), distance_(distance) {}
  std::size_t n_states() const override { return 1; }
  void start(double, double* z) const override { z[0] = 1.0; }
  void rates(Instant const& now, double const* z, double* dz) const override {
    dz[0] = now.direction == 0 ? 1.0 : -std::abs(now.v) * z[0] / distance_;
  }
  double dry(Instant const&, double const* z) const override { return rise_ * std::log1p(z[0] / onset_s_); }

 private:
  double rise_, onset_s_, distance_;
};

}  // namespace

Effect resting_bond(double rise, double onset_s, double distance) {
  return std::make_shared<RestingBond>(rise, onset_s, distance);
}

}  // namespace concealed
