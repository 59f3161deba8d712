// Pre-sliding friction: before it slides the contact bends like a spring, so friction builds up over a distance after
// each reversal instead of at once.
//
// Equation   tau = F (z - s) + sigma_1 dz/dt D; dz/dx = (1 - z / s) / D while x moves along s;
//            s = sign(dq) weighted by the Coulomb levels of the baseline (Dahl's model; F near the Coulomb level)
// Memory     z, carried over the distance by the exact exponential, so no step of time is too long
// Parameters presliding F >= 0 [N m; N]: the share of the Coulomb friction that builds up this way;
//            presliding_damping sigma_1 >= 0 [N m s/rad; N s/m]; presliding_distance D = Fc / sigma_0 [rad; m]
// Signature  distance since the reversal of the velocity, at any rate
// Confused   maxwell_slip, backlash, joint_elasticity, the filter's own artefact
// Source     Dahl 1968; Canudas de Wit, Olsson, Astrom, Lischinsky 1995 (LuGre)

#include <array>

#include "engine/effects/memory_effect.hpp"

namespace torquescope::effects {
namespace {

class DahlBristle {
 public:
  DahlBristle(double distance, JointScales const& scales) : distance_(distance), sign_(scales.friction_sign()) {}

  void start(JointState const& state) {
    q_ = state.q;
    z_ = sign_(state.dq);
  }

  // the stiffness 1 / distance is the same both ways, so the weaker direction is full sooner
  double decay_exponent(double way) const {
    double const full = sign_(way);
    return full == 0.0 ? 0.0 : -way / (distance_ * full);
  }
  void advance(JointState const& state, double, double decay) {
    double const step = state.q - q_, full = sign_(step);
    q_ = state.q;
    if (step != 0.0) z_ = full == 0.0 ? 0.0 : full + (z_ - full) * decay;
  }

  std::array<double, 2> row(JointState const& state) const {
    double const full = sign_(state.dq);
    return {z_ - full, full == 0.0 ? 0.0 : state.dq * (1.0 - z_ / full)};
  }

 private:
  double distance_;
  FrictionSign sign_;
  double q_ = 0.0, z_ = 0.0;
};

class Presliding final : public MemoryEffect {
 public:
  Presliding()
      : MemoryEffect(
            {.name = "presliding",
             .title = "friction that builds up over a distance after a reversal",
             .equation = "F (z - s) + sigma_1 D dz/dt, dz/dx = (1 - z / s) / D",
             .source = "Dahl 1968; Canudas de Wit, Olsson, Astrom, Lischinsky 1995",
             .separated_by =
                 "triangular strokes of several small amplitudes, with smaller loops inside larger ones, at two rates",
             .parameters = {{"presliding", "N m", "N", {0.0}, {1.0, RelativeTo::coulomb}},
                            {"presliding_damping", "N m s/rad", "N s/m", {0.0}},
                            shape_parameter("presliding_distance", "rad", "m", {1.0, RelativeTo::resolution},
                                            {0.02, RelativeTo::position_range}, Spacing::logarithmic)},
             .families = {EffectFamily::reversal},
             .signature = {SignatureAxis::since_velocity_reversal, SignatureAxis::velocity},
             .parity = Parity::odd,
             .is_dry_friction = true}) {}

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales,
                                       std::size_t lanes) const override {
    return memory_of(DahlBristle(shape[0], scales), lanes);
  }
};

}  // namespace

Effect const& presliding() {
  static Presliding const effect;
  return effect;
}

}  // namespace torquescope::effects
