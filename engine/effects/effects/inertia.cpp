// Inertia of the moving part with its drive, seen at the joint.
//
// Equation   tau = J ddq
// Source     seed eq. 3, x1

#include "engine/effects/described_effect.hpp"

namespace torquescope::effects {
namespace {

class Inertia final : public SingleColumnEffect {
 public:
  Inertia()
      : SingleColumnEffect(
            {"inertia", "inertia of joint and drive", "J ddq", "seed eq. 3, x1", {{"inertia", "kg m2", "kg"}}}) {}

 private:
  double column(JointState const& state) const override { return state.ddq; }
};

}  // namespace

Effect const& inertia() {
  static Inertia const effect;
  return effect;
}

}  // namespace torquescope::effects
