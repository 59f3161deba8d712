// Coulomb friction of the positive direction, as the seed writes it: a column of ones where the joint moves forwards.
//
// Equation   tau = Fc+ [dq > 0]
// Source     seed eq. 3, x3

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class CoulombPositive final : public InstantEffect {
 public:
  CoulombPositive()
      : InstantEffect({.name = "coulomb_positive",
                       .title = "Coulomb friction of the positive direction",
                       .equation = "Fc+ [dq > 0]",
                       .source = "seed eq. 3, x3",
                       .parameters = {{"coulomb_positive", "N m", "N"}},
                       .signature = {SignatureAxis::velocity},
                       .parity = Parity::neither,
                       .is_dry_friction = true,
                       .code = "coulomb_positive * (dq > 0)"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const>, JointScales const&, EffectColumns out) const override {
    out.col(0) = (at.dq > 0.0).cast<double>();
  }
};

}  // namespace

Effect const& coulomb_positive() {
  static CoulombPositive const effect;
  return effect;
}

}  // namespace torquescope::effects
