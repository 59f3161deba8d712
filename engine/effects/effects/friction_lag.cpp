// Frictional memory: the Stribeck part of friction answers a change of speed a little later.
//
// Equation   tau = s Fl (g(dq(t - tau_L)) - g(dq(t))), g(v) = 1 / (1 + (v / vs)^2);
//            s = sign(dq) weighted by the Coulomb levels of the baseline
// Memory     the velocities of the last tau_L
// Parameters friction_lag Fl >= 0 [N m; N]: height of the Stribeck part that lags; friction_lag_time tau_L [s];
//            friction_lag_speed vs [rad/s; m/s]
// Signature  velocity: the friction curve splits into a branch of speeding up and one of slowing down
// Confused   delay, presliding
// Source     Hess, Soom 1990; Armstrong-Helouvry, Dupont, Canudas de Wit 1994 (seven-parameter model)

#include <array>

#include "engine/effects/lagged_signal.hpp"
#include "engine/effects/memory_effect.hpp"

namespace torquescope::effects {
namespace {

class LaggingCurve {
 public:
  LaggingCurve(double lag_s, double speed, JointScales const& scales)
      : speed_(speed), sign_(scales.friction_sign()), velocity_(lag_s) {}
  void start(JointState const& state) { velocity_.start(state.time_s, state.dq); }
  void advance(JointState const& state, double) { velocity_.push(state.time_s, state.dq); }
  std::array<double, 1> row(JointState const& state) const {
    return {sign_(state.dq) * (curve(velocity_.lagged()) - curve(state.dq))};
  }

 private:
  double curve(double velocity) const { return 1.0 / (1.0 + velocity * velocity / (speed_ * speed_)); }

  double speed_;
  FrictionSign sign_;
  LaggedSignal velocity_;
};

class FrictionLag final : public MemoryEffect {
 public:
  FrictionLag()
      : MemoryEffect(
            {.name = "friction_lag",
             .title = "friction that answers a change of speed later",
             .equation = "s Fl (g(dq(t - tau_L)) - g(dq)), g(v) = 1 / (1 + (v / vs)^2)",
             .source = "Hess, Soom 1990; Armstrong-Helouvry, Dupont, Canudas de Wit 1994",
             .separated_by = "the same speed reached by speeding up and by slowing down, at three rates",
             .parameters = {{"friction_lag", "N m", "N", {0.0}, {2.0, RelativeTo::coulomb}},
                            shape_parameter("friction_lag_time", "s", "s", {0.2, RelativeTo::filter_time},
                                            {20.0, RelativeTo::filter_time}, Spacing::logarithmic),
                            shape_parameter("friction_lag_speed", "rad/s", "m/s", {0.002, RelativeTo::peak_speed},
                                            {0.5, RelativeTo::peak_speed}, Spacing::logarithmic)},
             .families = {EffectFamily::velocity_law, EffectFamily::reversal},
             .signature = {SignatureAxis::velocity, SignatureAxis::acceleration},
             .parity = Parity::odd,
             .is_dry_friction = true}) {}

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales,
                                       std::size_t lanes) const override {
    return memory_of(LaggingCurve(shape[0], shape[1], scales), lanes);
  }
};

}  // namespace

Effect const& friction_lag() {
  static FrictionLag const effect;
  return effect;
}

}  // namespace torquescope::effects
