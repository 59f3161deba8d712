// Break-away friction that grows while the joint rests: the contact ages, and sliding renews it.
//
// Equation   tau = s [Fd (1 - exp(-age / tau_d)) + Fa ln(1 + age / tau_d)], d age/dt = 1 / (1 + (dq / v_r)^2) - |dq|
//            age / D; s = sign(dq) weighted by the Coulomb levels of the baseline
// Memory     the age of the contact [s], exact for a constant speed over a step
// Parameters breakaway_dwell Fd >= 0 [N m; N]: after a very long rest, with an end (grease); breakaway_ageing Fa >= 0
//            [N m; N]: per e-fold of the rest, without end (dry contacts); dwell_time tau_d [s]; renewal_distance D
//            [rad; m]; rest_speed v_r [rad/s; m/s]: half of the ageing is left; small: only a standing contact ages
// Signature  distance since the reversal of the velocity: a spike whose height follows the rest before it
// Confused   stribeck; rests of different length tell them apart
// Source     Rabinowicz 1958; Ruina 1983, doi:10.1029/JB088iB12p10359 (ageing of contacts); Armstrong-Helouvry, Dupont,
//            Canudas de Wit 1994, doi:10.1016/0005-1098(94)90209-7 (dwell time)

#include "engine/effects/ageing_contacts.hpp"

namespace torquescope::effects {
namespace {

class BreakawayDwell final : public MemoryEffect {
 public:
  BreakawayDwell()
      : MemoryEffect({.name = "breakaway_dwell",
                      .title = "break-away friction that grows while the joint rests",
                      .equation = "s [Fd (1 - exp(-age / tau_d)) + Fa ln(1 + age / tau_d)], "
                                  "d age/dt = 1 / (1 + (dq / v_r)^2) - |dq| age / D",
                      .source = "Rabinowicz 1958; Ruina 1983; Armstrong-Helouvry, Dupont, Canudas de Wit 1994",
                      .separated_by = "rests of 0.1 to 30 s before each start",
                      .parameters = {{"breakaway_dwell", "N m", "N", {0.0}, {2.0, RelativeTo::coulomb}},
                                     {"breakaway_ageing", "N m", "N", {0.0}, {1.0, RelativeTo::coulomb}},
                                     shape_parameter("dwell_time", "s", "s", {0.001, RelativeTo::duration},
                                                     {0.5, RelativeTo::duration}, Spacing::logarithmic),
                                     shape_parameter("renewal_distance", "rad", "m", {1.0, RelativeTo::resolution},
                                                     {0.02, RelativeTo::position_range}, Spacing::logarithmic),
                                     shape_parameter("rest_speed", "rad/s", "m/s", {0.001, RelativeTo::peak_speed},
                                                     {1.0, RelativeTo::peak_speed}, Spacing::logarithmic)},
                      .families = {EffectFamily::reversal},
                      .signature = {SignatureAxis::since_velocity_reversal, SignatureAxis::time},
                      .parity = Parity::odd,
                      .is_dry_friction = true}) {}

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales,
                                       std::size_t lanes) const override {
    return ageing_contacts(
        {.dwell_s = shape[0], .renewal_distance = shape[1], .rest_speed = shape[2], .sign = scales.friction_sign()},
        lanes);
  }
};

}  // namespace

Effect const& breakaway_dwell() {
  static BreakawayDwell const effect;
  return effect;
}

}  // namespace torquescope::effects
