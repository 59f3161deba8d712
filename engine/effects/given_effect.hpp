#pragma once
// An effect of several joints, as one of them feels it: its columns come with the recording (EffectInput::given), since
// they are functions of the other joints' motion. Looked for in whole arms alone (arms/arm_effects.hpp).
//
// Columns    zero where the recording has none
// Simulation in replicates, whose other joints move as recorded (simulate/lane_effect.hpp). A single joint cannot be
//            simulated with it: runner() is an Error 78
// Threads    as Effect

#include "engine/effects/effect.hpp"

namespace torquescope {

class GivenEffect final : public Effect {
 public:
  explicit GivenEffect(EffectDescription description);
  bool has_memory() const override { return false; }
  void columns(EffectInput const& input, std::span<double const> shape, Eigen::Ref<Eigen::MatrixXd> out) const override;
  std::unique_ptr<EffectRunner> runner(std::span<double const> parameters, JointScales const& scales) const override;
  // 0: the joint's own state tells nothing of it
  double torque(JointState const& state, std::span<double const> parameters, JointScales const& scales) const override;
};

// of all joints of an arm; find_effect() knows them too
std::vector<Effect const*> const& arm_effect_choices();

}  // namespace torquescope
