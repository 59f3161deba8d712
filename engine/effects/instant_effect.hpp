#pragma once
// An effect without memory: its columns at one instant are a function of that instant. Files in effects/ add
// evaluate(), the equation over arrays: recordings, replicates and single instants all go through it.

#include "engine/effects/effect.hpp"
#include "engine/effects/joint_states.hpp"

namespace torquescope {

class InstantEffect : public Effect {
 public:
  using Effect::Effect;
  bool has_memory() const final { return false; }
  void columns(EffectInput const& input, std::span<double const> shape, Eigen::Ref<Eigen::MatrixXd> out) const override;
  std::unique_ptr<EffectRunner> runner(std::span<double const> parameters, JointScales const& scales) const override;
  double torque(JointState const& state, std::span<double const> parameters, JointScales const& scales) const final;
  // torque of each of these instants; all parameters, linear ones first; out: states.size()
  virtual void torques(JointStates const& at, std::span<double const> parameters, JointScales const& scales,
                       std::span<double> out) const;
  // with parameters of each instant; the bits of each instant alone
  virtual void torques_of_each(JointStates const& at, ParametersOfEach const& parameters, JointScales const& scales,
                               std::span<double> out) const;

 protected:
  // out: states.size() x n_linear(), no part of the states
  virtual void evaluate(JointStates const& at, std::span<double const> shape, JointScales const& scales,
                        EffectColumns out) const = 0;
  // with a shape of each instant: one after the other, unless a file has a faster way
  virtual void evaluate_each(JointStates const& at, ParametersOfEach const& shapes, JointScales const& scales,
                             EffectColumns out) const;
};

}  // namespace torquescope
