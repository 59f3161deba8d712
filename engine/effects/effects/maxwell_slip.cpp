// Maxwell-slip friction: springs of different length that slip one after the other, so that small loops lie within
// large ones and close on themselves.
//
// Equation   tau = sum_i F_i (z_i - s), dz_i/dx = 1 / d_i within the Coulomb levels, d_i = D / 4^(i-1), i = 1..4;
//            s = sign(dq) weighted by the Coulomb levels of the baseline
// Memory     z_i, exact for any step that does not turn round
// Parameters maxwell_slip_1..4 F_i >= 0 [N m; N], the longest first; maxwell_slip_distance D [rad; m]
// Signature  distance since the reversal of the velocity, and since the reversals before it
// Confused   presliding
// Source     Al-Bender, Lampaert, Swevers 2005 (rate-independent part)

#include <algorithm>
#include <array>

#include "engine/effects/memory_effect.hpp"

namespace torquescope::effects {
namespace {

class SlipElements {
 public:
  SlipElements(double longest, JointScales const& scales) : longest_(longest), sign_(scales.friction_sign()) {}

  void start(JointState const& state) {
    q_ = state.q;
    z_.fill(sign_(state.dq));
  }

  void advance(JointState const& state, double) {
    double const step = state.q - q_;
    q_ = state.q;
    double distance = longest_;
    for (auto& z : z_) {
      z = std::clamp(z + step / distance, sign_.backward, sign_.forward);
      distance /= 4.0;
    }
  }

  std::array<double, 4> row(JointState const& state) const {
    double const full = sign_(state.dq);
    std::array<double, 4> out{};
    for (std::size_t i = 0; i < z_.size(); ++i) out[i] = z_[i] - full;
    return out;
  }

 private:
  double longest_;
  FrictionSign sign_;
  double q_ = 0.0;
  std::array<double, 4> z_{};
};

class MaxwellSlip final : public MemoryEffect {
 public:
  MaxwellSlip()
      : MemoryEffect({.name = "maxwell_slip",
                      .title = "nested loops of friction after reversals",
                      .equation = "sum_i F_i (z_i - s), z_i slips after D / 4^(i-1)",
                      .source = "Al-Bender, Lampaert, Swevers 2005",
                      .separated_by = "trains of reversals with several amplitudes, smaller loops inside larger ones",
                      .parameters = {{"maxwell_slip_1", "N m", "N", {0.0}, {1.0, RelativeTo::coulomb}},
                                     {"maxwell_slip_2", "N m", "N", {0.0}, {1.0, RelativeTo::coulomb}},
                                     {"maxwell_slip_3", "N m", "N", {0.0}, {1.0, RelativeTo::coulomb}},
                                     {"maxwell_slip_4", "N m", "N", {0.0}, {1.0, RelativeTo::coulomb}},
                                     shape_parameter("maxwell_slip_distance", "rad", "m", {4.0, RelativeTo::resolution},
                                                     {0.05, RelativeTo::position_range}, Spacing::logarithmic)},
                      .families = {EffectFamily::reversal},
                      .signature = {SignatureAxis::since_velocity_reversal, SignatureAxis::velocity},
                      .parity = Parity::odd,
                      .is_dry_friction = true}) {}

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales,
                                       std::size_t lanes) const override {
    return memory_of(SlipElements(shape[0], scales), lanes);
  }
};

}  // namespace

Effect const& maxwell_slip() {
  static MaxwellSlip const effect;
  return effect;
}

}  // namespace torquescope::effects
