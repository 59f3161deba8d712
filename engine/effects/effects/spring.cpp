// Spring or counterbalance across the joint.
//
// Equation   tau = k q; the torque at q = 0 is the baseline's offset
// Parameters spring k [N m/rad; N/m]; negative: a counterbalance past its dead centre
// Signature  position: a straight line, even in the velocity
// Confused   gravity while the travel is below 60 degrees
// Source     Khalil, Dombre 2002, Modeling, Identification and Control of Robots

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class Spring final : public InstantEffect {
 public:
  Spring()
      : InstantEffect({.name = "spring",
                       .title = "spring or counterbalance across the joint",
                       .equation = "k q",
                       .source = "Khalil, Dombre 2002, Modeling, Identification and Control of Robots",
                       .separated_by = "slow motion over more than 120 degrees, or two orientations of the base",
                       .parameters = {{"spring",
                                       "N m/rad",
                                       "N/m",
                                       {-5.0, RelativeTo::torque_per_range},
                                       {5.0, RelativeTo::torque_per_range}}},
                       .families = {EffectFamily::static_position},
                       .signature = {SignatureAxis::position},
                       .parity = Parity::even,
                       .is_level_free = true}) {}

 private:
  void law(JointStates const& at, std::span<double const>, JointScales const&, LawColumns out) const override {
    out.col(0) = at.q;
  }
};

}  // namespace

Effect const& spring() {
  static Spring const effect;
  return effect;
}

}  // namespace torquescope::effects
