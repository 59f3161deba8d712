// Elastic end stop, or anything the joint leans on at one end of its travel.
//
// Equation   tau = (k x |x / x_r|^(p - 1) + d dq) [q beyond q_c], x = q - q_c, x_r a hundredth of the travel; beyond:
//            above it when q_c lies in the upper half of the travel, below it in the lower half
// Parameters end_stop k >= 0 [N m/rad; N/m]: torque over depth at x_r; end_stop_damping d >= 0 [N m s/rad; N s/m];
//            end_stop_position q_c [rad; m]; end_stop_power p [1]: 1 a spring, 1.5 round bodies that touch (Hertz), 2 a
//            cushion. With p fixed at 1 the stop is found too late
// Plausible  in the outer fifth of the travel on either side; in the middle a bent line would pass for a stop
// Signature  position: one end only
// Confused   cable
// Source     Hunt, Crossley 1975, doi:10.1115/1.3423596 (power of the depth; damping acts in contact only)

#include <cmath>

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class EndStop final : public InstantEffect {
 public:
  EndStop()
      : InstantEffect(
            {.name = "end_stop",
             .title = "elastic stop at one end of the travel",
             .equation = "(k x |x / x_r|^(p - 1) + d dq) [q beyond q_c], x = q - q_c, x_r 1 % of the travel",
             .source = "Hunt, Crossley 1975",
             .separated_by = "a slow approach to the stop, and the same positions left again",
             .parameters = {{"end_stop", "N m/rad", "N/m", {0.0}},
                            {"end_stop_damping", "N m s/rad", "N s/m", {0.0}},
                            shape_parameter("end_stop_position", "rad", "m", {-0.49, RelativeTo::position},
                                            {0.49, RelativeTo::position}, Spacing::linear),
                            effect_at_both(shape_parameter("end_stop_power", "1", "1", {1.0}, {2.0}, Spacing::linear))},
             .families = {EffectFamily::static_position},
             .signature = {SignatureAxis::position},
             .parity = Parity::neither,
             .is_of_extremes = true}) {}

  bool is_plausible(std::span<double const> shape, JointScales const& scales) const override {
    constexpr double outer = 0.3;  // of the range, from the centre
    return std::abs(shape[0] - scales.position_centre) >= outer * scales.position_range;
  }

 private:
  static constexpr double share_of_travel = 0.01;  // x_r

  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const& scales,
                EffectColumns out) const override {
    double const side = side_of(shape[0], scales);
    Scratch depth = press(at, side, shape[0], scales, out);
    if (shape[1] != 1.0) power_of_size(depth, shape[1]);
    out.col(0) = side * unit(scales) * depth;
  }

  void evaluate_each(JointStates const& at, ParametersOfEach const& shapes, JointScales const& scales,
                     EffectColumns out) const override {
    Scratch const side = shapes.col(0).unaryExpr([&](double stop) { return side_of(stop, scales); });
    Scratch const depth = press(at, side, NumberOfEach(shapes.col(0)), scales, out);
    Scratch grown = depth;
    power_of_size(grown, NumberOfEach(shapes.col(1)));
    out.col(0) = side * unit(scales) * (shapes.col(1) == 1.0).select(depth, grown);
  }

  static double unit(JointScales const& scales) { return share_of_travel * scales.position_range; }

  static double side_of(double stop, JointScales const& scales) { return stop >= scales.position_centre ? 1.0 : -1.0; }

  // how deep the stop is pressed, in units; puts the column of the damping
  template <typename Side, typename Number>
  static Scratch press(JointStates const& at, Side const& side, Number const& stop, JointScales const& scales,
                       EffectColumns out) {
    Scratch depth = (side * (at.q - stop)).max(0.0) / unit(scales);
    out.col(1) = (depth > 0.0).select(at.dq, 0.0);
    return depth;
  }
};

}  // namespace

Effect const& end_stop() {
  static EndStop const effect;
  return effect;
}

}  // namespace torquescope::effects
