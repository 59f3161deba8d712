// Viscous friction: linear in the velocity.
//
// Equation   tau = Fv dq
// Source     seed eq. 3, x2

#include "engine/effects/described_effect.hpp"

namespace torquescope::effects {
namespace {

class Viscous final : public SingleColumnEffect {
 public:
  Viscous()
      : SingleColumnEffect(
            {"viscous", "viscous friction", "Fv dq", "seed eq. 3, x2", {{"viscous", "N m s/rad", "N s/m"}}}) {}

 private:
  double column(JointState const& state) const override { return state.dq; }
};

}  // namespace

Effect const& viscous() {
  static Viscous const effect;
  return effect;
}

}  // namespace torquescope::effects
