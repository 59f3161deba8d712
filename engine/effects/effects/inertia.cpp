// Inertia of the moving part with its drive, seen at the joint.
//
// Equation   tau = J ddq
// Source     seed eq. 3, x1

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class Inertia final : public InstantEffect {
 public:
  Inertia()
      : InstantEffect({.name = "inertia",
                       .title = "inertia of joint and drive",
                       .equation = "J ddq",
                       .source = "seed eq. 3, x1",
                       .parameters = {{"inertia", "kg m2", "kg"}},
                       .signature = {SignatureAxis::acceleration},
                       .parity = Parity::even,
                       .is_rigid_body = true,
                       .code = "inertia * ddq"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const>, JointScales const&, EffectColumns out) const override {
    out.col(0) = at.ddq;
  }
};

}  // namespace

Effect const& inertia() {
  static Inertia const effect;
  return effect;
}

}  // namespace torquescope::effects
