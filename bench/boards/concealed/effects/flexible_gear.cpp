// A load behind a gear that winds up and stiffens as it does, as harmonic drives do.
//
// State      position and velocity of the load
// Equation   w = motor - load; torque = stiffness w (1 + (w / knee)^2) + damping dw/dt
#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class FlexibleGear final : public HiddenEffect {
 public:
  FlexibleGear(double load_inertia, double stiffness, double knee, double damping)
      : load_inertia_(load_inertia), stiffness_(stiffness), knee_(knee), damping_(damping) {}
  std::size_t n_states() const override { return 2; }
  void start(double q, double* z) const override { z[0] = q; }
  void rates(Instant const& now, double const* z, double* dz) const override {
    dz[0] = z[1];
    dz[1] = wound(now, z) / load_inertia_;
  }
  double torque(Instant const& now, double const* z) const override { return wound(now, z); }
  double moved_inertia() const override { return load_inertia_; }

 private:
  double wound(Instant const& now, double const* z) const {
    double const w = now.q - z[0], hard = w / knee_;
    return stiffness_ * w * (1.0 + hard * hard) + damping_ * (now.v - z[1]);
  }

  double load_inertia_, stiffness_, knee_, damping_;
};

}  // namespace

Effect flexible_gear(double load_inertia, double stiffness, double knee, double damping) {
  return std::make_shared<FlexibleGear>(load_inertia, stiffness, knee, damping);
}

}  // namespace concealed
