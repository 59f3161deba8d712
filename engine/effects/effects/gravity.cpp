// Weight of an eccentric link: any direction of the centre of mass, any zero of the angle.
//
// Equation   tau = g_sin sin(q) + g_cos cos(q)
// Errors     none here; the regressor refuses it for a prismatic joint, whose weight is a constant (offset)
// Source     Khalil, Dombre 2002, Modeling, Identification and Control of Robots

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class Gravity final : public InstantEffect {
 public:
  Gravity()
      : InstantEffect({.name = "gravity",
                       .title = "weight of an eccentric link",
                       .equation = "g_sin sin(q) + g_cos cos(q)",
                       .source = "Khalil, Dombre 2002, Modeling, Identification and Control of Robots",
                       .separated_by =
                           "slow motion in both directions over more than 90 degrees, in two orientations of the base",
                       .parameters = {{"gravity_sin", "N m", ""}, {"gravity_cos", "N m", ""}},
                       .families = {EffectFamily::static_position},
                       .signature = {SignatureAxis::position},
                       .parity = Parity::even,
                       .is_rigid_body = true,
                       .code = "gravity_sin * sin(q) + gravity_cos * cos(q)"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const>, JointScales const&, EffectColumns out) const override {
    cosine_sine(1.0, at.q, out.col(1), out.col(0));
  }
};

}  // namespace

Effect const& gravity() {
  static Gravity const effect;
  return effect;
}

}  // namespace torquescope::effects
