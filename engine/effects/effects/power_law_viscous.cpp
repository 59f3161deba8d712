// Friction that grows with a power of the speed: grease that thins under shear (alpha < 1) or thickens.
//
// Equation   tau = k sign(dq) |dq|^alpha
// Parameters power_law_viscous k >= 0 [N m (s/rad)^alpha; N (s/m)^alpha]: the torque at 1 rad/s
//            power_law_exponent alpha [1]; at 1 it is the viscous friction of the baseline, near 0 the Coulomb
//            friction; at the least, beside Coulomb friction, the logarithm of the speed (Eyring 1936,
//            doi:10.1063/1.1749836), at the most a drag of its square. Within a tenth of 1 it differs from viscous
//            friction by the tangent |dq| log |dq| alone: both grow without limit and cancel
// Signature  velocity: odd, curved at middle speeds
// Confused   stribeck with a wide speed, speed_drag
// Source     Waiboer, Aarts, Jonker 2005

#include <cmath>

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class PowerLawViscous final : public InstantEffect {
 public:
  PowerLawViscous()
      : InstantEffect({.name = "power_law_viscous",
                       .title = "friction that grows with a power of the speed",
                       .equation = "k sign(dq) |dq|^alpha",
                       .source = "Waiboer, Aarts, Jonker 2005",
                       .separated_by = "speeds spaced logarithmically, from creep to the fastest",
                       .parameters = {{"power_law_viscous", "N m (s/rad)^alpha", "N (s/m)^alpha", {0.0}},
                                      effect_at_both(shape_parameter("power_law_exponent", "1", "1", {0.2}, {2.0},
                                                                     Spacing::linear))},
                       .families = {EffectFamily::velocity_law, EffectFamily::reversal},
                       .signature = {SignatureAxis::velocity},
                       .parity = Parity::odd,
                       .code = "s * power_law_viscous * pow(fabs(dq), power_law_exponent)"}) {}

  bool is_plausible(std::span<double const> shape, JointScales const&) const override {
    constexpr double tenth = 0.1;
    return shape.empty() || std::abs(shape[0] - 1.0) >= tenth;
  }

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const&,
                EffectColumns out) const override {
    grow(at, shape[0], out);
  }

  void evaluate_each(JointStates const& at, ParametersOfEach const& shapes, JointScales const&,
                     EffectColumns out) const override {
    grow(at, NumberOfEach(shapes.col(0)), out);
  }

  template <typename Number>
  static void grow(JointStates const& at, Number const& exponent, EffectColumns out) {
    auto grown = out.col(0);
    grown = at.dq;
    power_of_size(grown, exponent);
    grown *= sign(at.dq);
  }
};

}  // namespace

Effect const& power_law_viscous() {
  static PowerLawViscous const effect;
  return effect;
}

}  // namespace torquescope::effects
