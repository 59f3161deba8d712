#pragma once
// An effect without memory: its columns at one instant are a function of that instant. Files in effects/ add row().

#include "engine/effects/effect.hpp"

namespace torquescope {

class InstantEffect : public Effect {
 public:
  using Effect::Effect;
  bool has_memory() const final { return false; }
  void columns(EffectInput const& input, std::span<double const> shape, Eigen::Ref<Eigen::MatrixXd> out) const override;
  std::unique_ptr<EffectRunner> runner(std::span<double const> parameters, JointScales const& scales) const override;
  double torque(JointState const& state, std::span<double const> parameters, JointScales const& scales) const final;

 protected:
  // torque per unit of each linear parameter; out: n_linear()
  virtual void row(JointState const& state, std::span<double const> shape, JointScales const& scales,
                   std::span<double> out) const = 0;
};

// -1, 0, 1; sign(0) = 0
inline double sign(double velocity) { return static_cast<double>((velocity > 0.0) - (velocity < 0.0)); }

}  // namespace torquescope
