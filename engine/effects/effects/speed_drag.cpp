// Drag that grows faster than the speed: churning oil, fan, eddy currents.
//
// Equation   tau = c2 dq |dq| + c3 dq^3
// Parameters quadratic_drag c2 >= 0 [N m s2/rad2; N s2/m2], cubic_drag c3 >= 0 [N m s3/rad3; N s3/m3]
// Signature  velocity: odd, at high speed
// Confused   power_law_viscous above 1
// Source     MuJoCo XML reference, dcmotor damping polynomial; Wahrburg et al. 2018

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class SpeedDrag final : public InstantEffect {
 public:
  SpeedDrag()
      : InstantEffect(
            {.name = "speed_drag",
             .title = "quadratic and cubic drag at high speed",
             .equation = "c2 dq |dq| + c3 dq^3",
             .source = "MuJoCo XML reference, damping polynomial; Wahrburg et al. 2018",
             .separated_by = "constant speeds over a range of four to one or more",
             .parameters = {{"quadratic_drag", "N m s2/rad2", "N s2/m2", {0.0}, {0.5, RelativeTo::torque_per_speed2}},
                            {"cubic_drag", "N m s3/rad3", "N s3/m3", {0.0}, {0.5, RelativeTo::torque_per_speed3}}},
             .families = {EffectFamily::velocity_law},
             .signature = {SignatureAxis::velocity},
             .parity = Parity::odd,
             .code = "quadratic_drag * dq * fabs(dq) + cubic_drag * dq * dq * dq"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const>, JointScales const&, EffectColumns out) const override {
    out.col(0) = at.dq * at.dq.abs();
    out.col(1) = at.dq * at.dq * at.dq;
  }
};

}  // namespace

Effect const& speed_drag() {
  static SpeedDrag const effect;
  return effect;
}

}  // namespace torquescope::effects
