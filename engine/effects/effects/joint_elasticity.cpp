// Flexible transmission: part of the inertia hangs on the motor by a spring and a damper.
//
// Equation   tau = J_l y'', y'' + 2 zeta w y' + w^2 y (1 + c (y / y_0)^2) = -ddq: y is the load relative to the motor,
//            w = 2 pi f; y_0 = a / w^2 is the wind-up that the acceleration a = torque rms / inertia makes of a
//            straight spring; the rigid part J_l ddq is in the baseline's inertia
// Memory     y and y', for c = 0 exact for an acceleration that is linear between two samples; what stiffens is a
//            kick before and after each step, of second order (Strang 1968, doi:10.1137/0705041)
// Why        an operator, not jerk and snap: a series of derivatives fails once the resonance lies in the band
// Signature  frequency: a narrow band fixed in time, excited by jerk
// Confused   delay, actuator_lag far below f
// Source     Spong 1987, doi:10.1115/1.3143860; Wernholt 2007; stiffening: Tuttle, Seering 1996, doi:10.1109/70.499819

#include "engine/effects/loads_on_spring.hpp"

namespace torquescope::effects {
namespace {

// f is that of the load with the motor held (antiresonance of the joint), unloaded. J_l is up to four times the fitted
// inertia, in which a load that lags has little part. Thin steel gears are softest unloaded; without the hardening c a
// gap would fit better, under a wrong name. A ringing load winds the spring up to twenty times y_0, so that only c = 0
// is none; the bounds of c are wide, since a soft spring that hardens much resembles a stiffer one that hardens little
class JointElasticity final : public MemoryEffect {
 public:
  JointElasticity()
      : MemoryEffect(
            {.name = "joint_elasticity",
             .title = "flexible transmission between motor and load",
             .equation = "J_l y'', y'' + 2 zeta w y' + w^2 y (1 + c (y / y0)^2) = -ddq, w = 2 pi f",
             .source = "Spong 1987; Wernholt 2007",
             .separated_by = "a multisine or chirp up to twice the resonance",
             .parameters = {{"load_inertia", "kg m2", "kg", {0.0}, {4.0, RelativeTo::inertia}},
                            resonance(shape_parameter("elasticity_frequency", "Hz", "Hz",
                                                      {0.05, RelativeTo::cutoff_frequency},
                                                      {1.5, RelativeTo::cutoff_frequency}, Spacing::logarithmic)),
                            shape_parameter("elasticity_damping", "1", "1", {0.005}, {0.2}, Spacing::logarithmic),
                            shape_parameter("elasticity_hardening", "1", "1", {0.0}, {8.0}, Spacing::cubic)},
             .families = {EffectFamily::acceleration},
             .signature = {SignatureAxis::frequency, SignatureAxis::acceleration},
             .parity = Parity::even,
             .has_inertia = true}) {}

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales,
                                       std::size_t lanes) const override {
    double const acceleration = scales.inertia > 0.0 ? scales.torque_rms / scales.inertia : 0.0;
    return load_on_spring::loads_on_spring({shape[0], shape[1], shape[2], acceleration}, lanes);
  }
};

}  // namespace

Effect const& joint_elasticity() {
  static JointElasticity const effect;
  return effect;
}

}  // namespace torquescope::effects
