// Elastic end stop, or anything the joint leans on at one end of its travel.
//
// Equation   tau = (k (q - q_c) + d dq) [q beyond q_c]; beyond: above it when q_c lies in the upper half of the travel,
//            below it in the lower half. Plausible in the outer fifth of the travel on either side: what begins in the middle
//            is no stop, and would pass for one as a bent line
// Parameters end_stop k >= 0 [N m/rad; N/m], end_stop_damping d >= 0 [N m s/rad; N s/m]; end_stop_position q_c [rad; m]
// Signature  position: one end only
// Confused   cable
// Source     PHYSICS.md G4; Hunt, Crossley 1975 (damping acts in contact only)

#include <cmath>

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class EndStop final : public InstantEffect {
 public:
  EndStop()
      : InstantEffect({.name = "end_stop",
                       .title = "elastic stop at one end of the travel",
                       .equation = "(k (q - q_c) + d dq) [q beyond q_c]",
                       .source = "Hunt, Crossley 1975",
                       .separated_by = "a slow approach to the stop, and the same positions left again",
                       .parameters = {{"end_stop", "N m/rad", "N/m", {0.0}},
                                      {"end_stop_damping", "N m s/rad", "N s/m", {0.0}},
                                      shape_parameter("end_stop_position", "rad", "m", {-0.49, RelativeTo::position},
                                                      {0.49, RelativeTo::position}, Spacing::linear)},
                       .families = {EffectFamily::static_position},
                       .signature = {SignatureAxis::position},
                       .parity = Parity::neither,
                       .is_of_extremes = true}) {}

  bool is_plausible(std::span<double const> shape, JointScales const& scales) const override {
    constexpr double outer = 0.3;  // of the range, from the centre
    return std::abs(shape[0] - scales.position_centre) >= outer * scales.position_range;
  }

 private:
  void law(JointStates const& at, std::span<double const> shape, JointScales const& scales,
           LawColumns out) const override {
    double const side = shape[0] >= scales.position_centre ? 1.0 : -1.0;
    auto const is_beyond = side * (at.q - shape[0]) > 0.0;
    out.col(0) = is_beyond.select(at.q - shape[0], 0.0);
    out.col(1) = is_beyond.select(at.dq, 0.0);
  }
};

}  // namespace

Effect const& end_stop() {
  static EndStop const effect;
  return effect;
}

}  // namespace torquescope::effects
