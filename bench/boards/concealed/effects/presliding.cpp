// Dry friction that builds up over a distance after each reversal and never holds the joint rigidly.
//
// Equation   dF/dx = stiffness |1 - s F / coulomb|^2 sign(1 - s F / coulomb), s = direction of motion;
//            F approaches coulomb like a hyperbola, not like Dahl's exponential
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class BristlePresliding final : public HiddenEffect {
 public:
  BristlePresliding(double coulomb, double stiffness) : coulomb_(coulomb), stiffness_(stiffness) {}
  std::size_t n_states() const override { return 1; }
  void rates(Instant const& now, double const* z, double* dz) const override {
    double const room = 1.0 - now.direction * z[0] / coulomb_;
    dz[0] = stiffness_ * room * std::abs(room) * now.v;
  }
  double torque(Instant const&, double const* z) const override { return z[0]; }
  double dry(Instant const&, double const*) const override { return -coulomb_; }

 private:
  double coulomb_, stiffness_;
};

}  // namespace

Effect bristle_presliding(double coulomb, double stiffness) {
  return std::make_shared<BristlePresliding>(coulomb, stiffness);
}

}  // namespace concealed
