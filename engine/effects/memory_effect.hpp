#pragma once
// An effect whose columns depend on what happened before: it runs a state over the motion, the same one for
// identification and for simulation. Files in effects/ add the state.

#include "engine/effects/effect.hpp"

namespace torquescope {

// the state behind the columns of one effect at one shape
class EffectMemory {
 public:
  virtual ~EffectMemory() = default;
  virtual void start(JointState const& state) = 0;
  virtual void advance(JointState const& state, double step_s) = 0;  // step_s > 0
  // torque per unit of each linear parameter, memory as it stands
  virtual void row(JointState const& state, std::span<double> out) const = 0;
};

class MemoryEffect : public Effect {
 public:
  using Effect::Effect;
  bool has_memory() const final { return true; }
  void columns(EffectInput const& input, std::span<double const> shape, Eigen::Ref<Eigen::MatrixXd> out) const override;
  std::unique_ptr<EffectRunner> runner(std::span<double const> parameters, JointScales const& scales) const override;

 protected:
  virtual std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales) const = 0;
};

}  // namespace torquescope
