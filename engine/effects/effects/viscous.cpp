// Viscous friction: linear in the velocity.
//
// Equation   tau = Fv dq
// Source     seed eq. 3, x2

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class Viscous final : public InstantEffect {
 public:
  Viscous()
      : InstantEffect({.name = "viscous",
                       .title = "viscous friction",
                       .equation = "Fv dq",
                       .source = "seed eq. 3, x2",
                       .parameters = {{"viscous", "N m s/rad", "N s/m"}},
                       .signature = {SignatureAxis::velocity},
                       .parity = Parity::odd,
                       .code = "viscous * dq"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const>, JointScales const&, EffectColumns out) const override {
    out.col(0) = at.dq;
  }
};

}  // namespace

Effect const& viscous() {
  static Viscous const effect;
  return effect;
}

}  // namespace torquescope::effects
