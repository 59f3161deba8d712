// Coulomb friction, equal in both directions; zero at rest.
//
// Equation   tau = Fc sign(dq)
// Source     Armstrong-Helouvry 1991, Control of Machines with Friction

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class Coulomb final : public InstantEffect {
 public:
  Coulomb()
      : InstantEffect({.name = "coulomb",
                       .title = "Coulomb friction, equal in both directions",
                       .equation = "Fc sign(dq)",
                       .source = "Armstrong-Helouvry 1991, Control of Machines with Friction",
                       .parameters = {{"coulomb", "N m", "N"}},
                       .signature = {SignatureAxis::velocity},
                       .parity = Parity::odd,
                       .is_dry_friction = true,
                       .code = "coulomb * s"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const>, JointScales const&, EffectColumns out) const override {
    out.col(0) = sign(at.dq);
  }
};

}  // namespace

Effect const& coulomb() {
  static Coulomb const effect;
  return effect;
}

}  // namespace torquescope::effects
