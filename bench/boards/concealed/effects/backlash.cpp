// A load that the motor only moves once it has crossed a gap.
//
// State      position and velocity of the load
// Equation   wind = motor - load position beyond the flank; contact = (stiffness + damping d(wind)/dt) wind, never
//            pulling (Hunt, Crossley 1975: no jump of the force at contact), and film d(wind)/dt of the grease in the
//            gap
#include <algorithm>
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class Backlash final : public HiddenEffect {
 public:
  Backlash(double load_inertia, double half_gap, double stiffness, double damping, double film)
      : load_inertia_(load_inertia), half_gap_(half_gap), stiffness_(stiffness), damping_(damping), film_(film) {}
  std::size_t n_states() const override { return 2; }
  void start(double q, double* z) const override { z[0] = q; }
  void rates(Instant const& now, double const* z, double* dz) const override {
    dz[0] = z[1];
    dz[1] = contact(now, z) / load_inertia_;
  }
  double torque(Instant const& now, double const* z) const override { return contact(now, z); }
  double moved_inertia() const override { return load_inertia_; }

 private:
  double contact(Instant const& now, double const* z) const {
    double const apart = now.q - z[0];
    double const depth = std::abs(apart) - half_gap_;
    double const squeezed = film_ * (now.v - z[1]);
    if (depth <= 0.0) return squeezed;
    double const side = apart > 0.0 ? 1.0 : -1.0;
    return squeezed + side * depth * std::max(0.0, stiffness_ + damping_ * side * (now.v - z[1]));
  }

  double load_inertia_, half_gap_, stiffness_, damping_, film_;
};

}  // namespace

Effect backlash(double load_inertia, double half_gap, double stiffness, double damping, double film) {
  return std::make_shared<Backlash>(load_inertia, half_gap, stiffness, damping, film);
}

}  // namespace concealed
