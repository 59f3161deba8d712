// A current loop of second order between the recorded command and the torque.
//
// State      torque and its rate
// Equation   z'' = w^2 (motor - z) - 2 damping w z'; a ramp of the command is followed 2 damping / w late
#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class CurrentLoop final : public HiddenEffect {
 public:
  CurrentLoop(double late_s, double damping) : omega_(2.0 * damping / late_s), damping_(damping) {}
  std::size_t n_states() const override { return 2; }
  void rates(Instant const& now, double const* z, double* dz) const override {
    dz[0] = z[1];
    dz[1] = omega_ * (omega_ * (now.motor - z[0]) - 2.0 * damping_ * z[1]);
  }
  double torque(Instant const& now, double const* z) const override { return now.motor - z[0]; }

 private:
  double omega_, damping_;
};

}  // namespace

Effect current_loop(double late_s, double damping) { return std::make_shared<CurrentLoop>(late_s, damping); }

}  // namespace concealed
