// Cables and hoses that bend with the joint: a hardening spring with a loop.
//
// Equation   tau = k1 x + k2 x^2 + k3 x^3 + C z, dz/dx = (1 - z / sign(dx)) / D; x = q - q_c, q_c: the middle of the
//            travel. The square is there because a hose is straight at another place than q_c
// Memory     z, carried over the distance by the exact exponential
// Parameters cable_stiffness k1 [N m/rad; N/m], cable_quadratic k2 [N m/rad2; N/m2], cable_cubic k3 [N m/rad3; N/m3],
//            cable_loop C >= 0 [N m; N]; cable_distance D [rad; m]
// Signature  position, with a loop much wider than pre-sliding
// Confused   spring, gravity, presliding
// Source     hardening spring: Duffing 1918; loop: Dahl 1968, A solid friction model, Aerospace Corporation

#include <array>
#include <cmath>

#include "engine/effects/memory_effect.hpp"

namespace torquescope::effects {
namespace {

class CableLoop {
 public:
  CableLoop(double distance, double centre) : distance_(distance), centre_(centre) {}

  void start(JointState const& state) {
    q_ = state.q;
    z_ = 0.0;
  }

  double decay_exponent(double way) const { return -std::abs(way) / distance_; }
  void advance(JointState const& state, double, double decay) {
    double const full = std::copysign(1.0, state.q - q_);
    q_ = state.q;
    z_ = full + (z_ - full) * decay;
  }

  std::array<double, 4> row(JointState const& state) const {
    double const x = state.q - centre_;
    return {x, x * x, x * x * x, z_};
  }

 private:
  double distance_, centre_;
  double q_ = 0.0, z_ = 0.0;
};

class Cable final : public MemoryEffect {
 public:
  Cable()
      : MemoryEffect(
            {.name = "cable",
             .title = "cables and hoses: hardening spring with a loop",
             .equation =
                 "k1 x + k2 x^2 + k3 x^3 + C z, dz/dx = (1 - z / sign(dx)) / D, x = q - q_c (middle of the travel)",
             .source = "Dahl 1968 (loop); FloBaRoID (cable torque)",
             .separated_by = "slow loops over the full range",
             .parameters = {{"cable_stiffness",
                             "N m/rad",
                             "N/m",
                             {-5.0, RelativeTo::torque_per_range},
                             {5.0, RelativeTo::torque_per_range}},
                            {"cable_quadratic",
                             "N m/rad2",
                             "N/m2",
                             {-10.0, RelativeTo::torque_per_range2},
                             {10.0, RelativeTo::torque_per_range2}},
                            {"cable_cubic",
                             "N m/rad3",
                             "N/m3",
                             {-20.0, RelativeTo::torque_per_range3},
                             {20.0, RelativeTo::torque_per_range3}},
                            {"cable_loop", "N m", "N", {0.0}, {1.0, RelativeTo::torque}},
                            shape_parameter("cable_distance", "rad", "m", {0.02, RelativeTo::position_range},
                                            {0.5, RelativeTo::position_range}, Spacing::logarithmic)},
             .families = {EffectFamily::static_position, EffectFamily::reversal},
             .signature = {SignatureAxis::position, SignatureAxis::since_velocity_reversal},
             .parity = Parity::neither,
             .is_level_free = true}) {}

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales,
                                       std::size_t lanes) const override {
    return memory_of(CableLoop(shape[0], scales.position_centre), lanes);
  }
};

}  // namespace

Effect const& cable() {
  static Cable const effect;
  return effect;
}

}  // namespace torquescope::effects
