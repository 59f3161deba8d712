// Frictional memory: the Stribeck part of friction answers a change of speed a little later.
//
// Equation   tau = s Fl (g(w) - g(dq)), g(v) = 1 / (1 + (v / vs)^2), w the speed that the film is made for:
//            (1 - d) tau_L w' = |dq(t - d tau_L)| - w; s = sign(dq) weighted by the Coulomb levels of the baseline
// Memory     w, and the speeds of the last d tau_L
// Parameters friction_lag Fl >= 0 [N m; N]: height of the Stribeck part that lags; friction_lag_time tau_L [s];
//            friction_lag_speed vs [rad/s; m/s]; friction_lag_dead_share d [1]: of the lag that is dead time
// Why        measured lags are told as a dead time (Hess, Soom) or as a state that relaxes (Dieterich, Ruina); after a
//            fast stretch the two differ by as much as either explains
// Signature  velocity: the friction curve splits into a branch of speeding up and one of slowing down
// Confused   delay, presliding
// Source     Hess, Soom 1990; Ruina 1983; Armstrong-Helouvry, Dupont, Canudas de Wit 1994 (seven-parameter model)

#include <array>
#include <cmath>

#include "engine/effects/lagged_signal.hpp"
#include "engine/effects/memory_effect.hpp"
#include "engine/effects/remembered_steps.hpp"

namespace torquescope::effects {
namespace {

class LaggingCurve {
 public:
  LaggingCurve(double lag_s, double speed, double dead_share, JointScales const& scales)
      : speed_(speed),
        sign_(scales.friction_sign()),
        is_late_(dead_share > 0.0),
        relaxes_in_s_((1.0 - dead_share) * lag_s),
        late_(dead_share * lag_s) {}
  void start(JointState const& state) {
    film_speed_ = arrived_ = std::abs(state.dq);
    late_.start(state.time_s, film_speed_);
  }
  void advance(JointState const& state, double step_s) {
    double const before = arrived_;
    arrived_ = std::abs(state.dq);
    if (is_late_) {
      late_.push(state.time_s, arrived_);
      arrived_ = late_.lagged();
    }
    follow(before, step_s);
  }
  std::array<double, 1> row(JointState const& state) const {
    return {sign_(state.dq) * (curve(film_speed_) - curve(state.dq))};
  }

 private:
  // exact for a speed that runs straight within the step
  void follow(double before, double step_s) {
    double const steps = step_s / relaxes_in_s_;
    if (!(steps < 40.0)) {
      film_speed_ = arrived_;
      return;
    }
    double const gone = gone_.of(steps, [](double of) { return -std::expm1(-of); });
    double const slope = (arrived_ - before) / steps;
    film_speed_ += gone * (before - slope - film_speed_) + (arrived_ - before);
  }
  double curve(double velocity) const { return 1.0 / (1.0 + velocity * velocity / (speed_ * speed_)); }

  double speed_;
  FrictionSign sign_;
  bool is_late_;
  double relaxes_in_s_;
  LaggedSignal late_;
  RememberedSteps<double> gone_{};  // in a step of so many relaxation times
  double arrived_ = 0.0, film_speed_ = 0.0;
};

class FrictionLag final : public MemoryEffect {
 public:
  FrictionLag()
      : MemoryEffect(
            {.name = "friction_lag",
             .title = "friction that answers a change of speed later",
             .equation = "s Fl (g(w) - g(dq)), g(v) = 1 / (1 + (v / vs)^2), (1 - d) tau_L w' = |dq(t - d tau_L)| - w",
             .source = "Hess, Soom 1990; Ruina 1983; Armstrong-Helouvry, Dupont, Canudas de Wit 1994",
             .separated_by = "the same speed reached by speeding up and by slowing down, at three rates",
             .parameters = {{"friction_lag", "N m", "N", {0.0}, {2.0, RelativeTo::coulomb}},
                            shape_parameter("friction_lag_time", "s", "s", {0.2, RelativeTo::filter_time},
                                            {20.0, RelativeTo::filter_time}, Spacing::logarithmic),
                            shape_parameter("friction_lag_speed", "rad/s", "m/s", {0.002, RelativeTo::peak_speed},
                                            {0.5, RelativeTo::peak_speed}, Spacing::logarithmic),
                            effect_at_upper(
                                shape_parameter("friction_lag_dead_share", "1", "1", {0.0}, {1.0}, Spacing::linear))},
             .families = {EffectFamily::velocity_law, EffectFamily::reversal},
             .signature = {SignatureAxis::velocity, SignatureAxis::acceleration},
             .parity = Parity::odd,
             .is_dry_friction = true}) {}

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales,
                                       std::size_t lanes) const override {
    return memory_of(LaggingCurve(shape[0], shape[1], shape[2], scales), lanes);
  }
};

}  // namespace

Effect const& friction_lag() {
  static FrictionLag const effect;
  return effect;
}

}  // namespace torquescope::effects
