// Backlash: the load hangs behind a gap of 2 b with soft flanks, and lies on one of them only while it is pushed.
//
// Equation   tau = J_l (a - a_0), a_0 = ddq + (g + d (Fv dq + Fc sign(dq))) / J: the acceleration of a load fixed to
//            the motor; y'' = a - ddq - (g + d (Fv v + Fc sign(v))) / J, v = dq + y'; y: load relative to the motor;
//            a = -(w^2 dz(y, b) + 2 zeta w y') on a flank, w = 2 pi f, dz the way beyond the gap; a = -c y' in the gap
//            and where a flank would pull. J_l ddq, gravity g and friction Fv, Fc are the baseline's
// Memory     y and y', exact on a flank and in the gap for an acceleration that is linear between two samples; contact
//            and release are searched within sub-steps of 1/4 rad of the contact frequency
// Signature  distance since the reversal of the torque: the load is missing for 2 b, then knocks and rings
// Confused   joint_elasticity (no gap), presliding (reversal of the velocity), delay
// Source     Nordin, Gutman 2002, Controlling mechanical systems with backlash, doi:10.1016/S0005-1098(02)00047-X

#include <numbers>

#include "engine/effects/loads_behind_gap.hpp"

namespace torquescope::effects {
namespace {

// Flanks are soft: a rigid load with a plastic impact misses the ringing after contact, which is most of what shows.
// The push decides, not the velocity: a joint that gravity holds on one flank has no gap at its reversals. J_l is up to
// four times the fitted inertia (joint_elasticity.cpp); f is that of the load in contact with the motor held. Without
// the film c (grease in the gap) a film passes for a wider gap. A drag d of 0.001 is none; a load braked by its own
// bearings moves against the joint before the joint turns, or rests in the gap while the joint moves on
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

  // below a tenth of the wind-up a / w^2 of the flank the gap is not what shows: the name is joint_elasticity
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
