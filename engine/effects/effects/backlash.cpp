// Backlash: the load hangs behind a gap of 2 b whose flanks give way, and lies on the one or the other only while it is
// pushed.
//
// Equation   tau = J_l (a - a_0), a_0 = ddq + (g + d (Fv dq + Fc sign(dq))) / J: what a load that is fixed to the motor
//            would need; y'' = a - ddq - (g + d (Fv v + Fc sign(v))) / J, v = dq + y' the load's own speed, a = -(w^2
//            dz(y, b) + 2 zeta w y'), w = 2 pi f: y is the load relative to the motor, dz its way beyond the gap; a =
//            -c y' in the gap, which grease fills, and where a flank would pull. The rigid part J_l ddq, the gravity g
//            and the friction Fv, Fc are the baseline's; the load has the same share of gravity as of the inertia J,
//            and d times that share of the friction, viscous and dry
// Memory     y and y', exact on a flank and in the gap for an acceleration that runs straight between two samples; the
//            instant of contact or release is searched within sub-steps of 1/4 rad of the contact frequency
// Why        flanks are soft: a rigid load and a plastic impact miss the ringing after contact, which is most of what
//            shows. The push decides, not the velocity: a joint that gravity holds on one flank has no gap at its
//            reversals
// Parameters backlash_load_inertia J_l >= 0 [kg m2; kg], up to four times the fitted inertia (joint_elasticity.cpp);
// backlash_half_gap b [rad; m];
//            backlash_frequency f [Hz]: of the load in contact with the motor held; backlash_damping zeta [1];
//            backlash_film c [1/s]: how fast grease takes the speed of a load that crosses the gap. Without it a film
//            passes for a wider gap; backlash_load_drag d [1]: a load that is braked by its own bearings turns against
//            the joint before that turns, or rests in the gap while the joint moves on; 0.001 is none. By decades: of
//            most gaps it is small
// Plausible  while b is no less than a tenth of the wind-up a / w^2 that the acceleration a = torque rms / inertia
//            makes of the flank: below that the gap is not what shows, and the name is joint_elasticity
// Signature  distance since the reversal of the torque: the load is missing for 2 b, then blows and rings
// Confused   joint_elasticity (no gap), presliding (reversal of the velocity), delay
// Source     Nordin, Gutman 2002; LESSONS.md item 10

#include <numbers>

#include "engine/effects/loads_behind_gap.hpp"

namespace torquescope::effects {
namespace {

class Backlash final : public MemoryEffect {
 public:
  Backlash()
      : MemoryEffect(
            {.name = "backlash",
             .title = "lost motion: the load hangs behind a gap",
             .equation = "J_l y'', y'' + [w^2 dz(y, b) + 2 zeta w y' in contact, never pulling, else c y'] = -ddq - (g "
                         "+ d Fv v + d Fc sign(v)) / J, v = dq + y', w = 2 pi f",
             .source = "Nordin, Gutman 2002",
             .separated_by = "reversals with and without a load that holds one flank; encoders on both sides",
             .parameters = {{"backlash_load_inertia", "kg m2", "kg", {0.0}, {4.0, RelativeTo::inertia}},
                            shape_parameter("backlash_half_gap", "rad", "m", {1.0, RelativeTo::resolution},
                                            {0.02, RelativeTo::position_range}, Spacing::logarithmic),
                            shape_parameter("backlash_frequency", "Hz", "Hz", {0.2, RelativeTo::cutoff_frequency},
                                            {3.0, RelativeTo::cutoff_frequency}, Spacing::logarithmic),
                            shape_parameter("backlash_damping", "1", "1", {0.02}, {0.7}, Spacing::logarithmic),
                            shape_parameter("backlash_film", "1/s", "1/s", {0.0}, {2.0, RelativeTo::cutoff_frequency},
                                            Spacing::linear),
                            none_at_lower(
                                shape_parameter("backlash_load_drag", "1", "1", {0.001}, {2.0}, Spacing::logarithmic))},
             .families = {EffectFamily::reversal},
             .signature = {SignatureAxis::since_torque_reversal, SignatureAxis::acceleration},
             .parity = Parity::neither,
             .needs_baseline = true,
             .has_inertia = true,
             .is_partly_dry = true}) {}

  bool is_plausible(std::span<double const> shape, JointScales const& scales) const override {
    constexpr double least_share = 0.1;
    double const omega = 2.0 * std::numbers::pi * shape[1];
    double const acceleration = scales.inertia > 0.0 ? scales.torque_rms / scales.inertia : 0.0;
    return shape[0] >= least_share * acceleration / (omega * omega);
  }

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales,
                                       std::size_t lanes) const override {
    return load_behind_gap::loads_behind_gap({shape[0], shape[1], shape[2], shape[3], shape[4], scales}, lanes);
  }
};

}  // namespace

Effect const& backlash() {
  static Backlash const effect;
  return effect;
}

}  // namespace torquescope::effects
