// Coulomb friction, equal in both directions; zero at rest.
//
// Equation   tau = Fc sign(dq)
// Source     Armstrong-Helouvry 1991, Control of Machines with Friction

#include "engine/effects/described_effect.hpp"

namespace torquescope::effects {
namespace {

class Coulomb final : public SingleColumnEffect {
 public:
  Coulomb()
      : SingleColumnEffect({"coulomb",
                            "Coulomb friction, equal in both directions",
                            "Fc sign(dq)",
                            "Armstrong-Helouvry 1991, Control of Machines with Friction",
                            {{"coulomb", "N m", "N"}}}) {}
  bool is_dry_friction() const override { return true; }

 private:
  double column(JointState const& state) const override { return sign(state.dq); }
};

}  // namespace

Effect const& coulomb() {
  static Coulomb const effect;
  return effect;
}

}  // namespace torquescope::effects
