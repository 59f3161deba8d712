// Coulomb friction of the negative direction, as the seed writes it: ones where the joint moves backwards, so that the
// parameter of a joint with friction is negative (a4 = -0.2582 in the seed).
//
// Equation   tau = Fc- [dq < 0]
// Source     seed eq. 3, x4

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class CoulombNegative final : public InstantEffect {
 public:
  CoulombNegative()
      : InstantEffect({.name = "coulomb_negative",
                       .title = "Coulomb friction of the negative direction (a negative parameter)",
                       .equation = "Fc- [dq < 0]",
                       .source = "seed eq. 3, x4",
                       .parameters = {{"coulomb_negative", "N m", "N"}},
                       .signature = {SignatureAxis::velocity},
                       .parity = Parity::neither,
                       .is_dry_friction = true,
                       .code = "coulomb_negative * (dq < 0)"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const>, JointScales const&, EffectColumns out) const override {
    out.col(0) = (at.dq < 0.0).cast<double>();
  }
};

}  // namespace

Effect const& coulomb_negative() {
  static CoulombNegative const effect;
  return effect;
}

}  // namespace torquescope::effects
