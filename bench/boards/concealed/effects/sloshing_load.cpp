// Liquid in a tank on the link: it swings against the link with a frequency that falls with the amplitude.
//
// State      position and velocity of the liquid, in the frame of the room
// Equation   x = link - liquid; acceleration of the liquid  w^2 limit tanh(x / limit) + 2 damping w dx/dt
#include <cmath>
#include <numbers>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class SloshingLoad final : public HiddenEffect {
 public:
  SloshingLoad(double inertia, double frequency_hz, double damping, double limit)
      : inertia_(inertia), omega_(2.0 * std::numbers::pi * frequency_hz), damping_(damping), limit_(limit) {}
  std::size_t n_states() const override { return 2; }
  void start(double q, double* z) const override { z[0] = q; }
  void rates(Instant const& now, double const* z, double* dz) const override {
    dz[0] = z[1];
    dz[1] = pull(now, z);
  }
  double torque(Instant const& now, double const* z) const override { return inertia_ * pull(now, z); }
  double moved_inertia() const override { return inertia_; }

 private:
  double pull(Instant const& now, double const* z) const {
    double const apart = now.q - z[0];
    return omega_ * omega_ * limit_ * std::tanh(apart / limit_) + 2.0 * damping_ * omega_ * (now.v - z[1]);
  }

  double inertia_, omega_, damping_, limit_;
};

}  // namespace

Effect sloshing_load(double inertia, double frequency_hz, double damping, double limit) {
  return std::make_shared<SloshingLoad>(inertia, frequency_hz, damping, limit);
}

}  // namespace concealed
