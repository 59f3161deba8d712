// Viscous friction that differs between the directions, as of a screw or an oil seal.
//
// Equation   tau = Fa |dq|; with the baseline's Fv dq: slopes Fv + Fa forwards and Fv - Fa backwards
// Parameters asymmetric_viscous Fa [N m s/rad; N s/m], either sign, up to half the viscous friction
// Signature  velocity: a V, even
// Confused   offset and gravity while the joint moves one way only
// Source     Elhami, Brookfield 1996

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class AsymmetricViscous final : public InstantEffect {
 public:
  AsymmetricViscous()
      : InstantEffect({.name = "asymmetric_viscous",
                       .title = "viscous friction that differs between the directions",
                       .equation = "Fa |dq|",
                       .source = "Elhami, Brookfield 1996",
                       .separated_by = "two or more speeds in each direction over the same positions",
                       .parameters = {{"asymmetric_viscous",
                                       "N m s/rad",
                                       "N s/m",
                                       {-0.5, RelativeTo::viscous},
                                       {0.5, RelativeTo::viscous}}},
                       .families = {EffectFamily::velocity_law},
                       .signature = {SignatureAxis::velocity},
                       .parity = Parity::even,
                       .code = "asymmetric_viscous * fabs(dq)"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const>, JointScales const&, EffectColumns out) const override {
    out.col(0) = at.dq.abs();
  }
};

}  // namespace

Effect const& asymmetric_viscous() {
  static AsymmetricViscous const effect;
  return effect;
}

}  // namespace torquescope::effects
