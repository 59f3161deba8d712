// Coulomb friction of the positive direction, as the seed writes it: a column of ones where the joint moves forwards.
//
// Equation   tau = Fc+ [dq > 0]
// Source     seed eq. 3, x3

#include "engine/effects/described_effect.hpp"

namespace torquescope::effects {
namespace {

class CoulombPositive final : public SingleColumnEffect {
 public:
  CoulombPositive()
      : SingleColumnEffect({"coulomb_positive",
                            "Coulomb friction of the positive direction",
                            "Fc+ [dq > 0]",
                            "seed eq. 3, x3",
                            {{"coulomb_positive", "N m", "N"}}}) {}
  bool is_dry_friction() const override { return true; }

 private:
  double column(JointState const& state) const override { return state.dq > 0.0 ? 1.0 : 0.0; }
};

}  // namespace

Effect const& coulomb_positive() {
  static CoulombPositive const effect;
  return effect;
}

}  // namespace torquescope::effects
