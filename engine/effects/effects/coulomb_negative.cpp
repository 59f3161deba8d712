// Coulomb friction of the negative direction, as the seed writes it: ones where the joint moves backwards, so that the
// parameter of a joint with friction is negative (a4 = -0.2582 in the seed).
//
// Equation   tau = Fc- [dq < 0]
// Source     seed eq. 3, x4

#include "engine/effects/described_effect.hpp"

namespace torquescope::effects {
namespace {

class CoulombNegative final : public SingleColumnEffect {
 public:
  CoulombNegative()
      : SingleColumnEffect({"coulomb_negative",
                            "Coulomb friction of the negative direction (a negative parameter)",
                            "Fc- [dq < 0]",
                            "seed eq. 3, x4",
                            {{"coulomb_negative", "N m", "N"}}}) {}
  bool is_dry_friction() const override { return true; }

 private:
  double column(JointState const& state) const override { return state.dq < 0.0 ? 1.0 : 0.0; }
};

}  // namespace

Effect const& coulomb_negative() {
  static CoulombNegative const effect;
  return effect;
}

}  // namespace torquescope::effects
