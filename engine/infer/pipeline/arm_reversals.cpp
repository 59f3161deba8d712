#include "engine/infer/pipeline/arm_reversals.hpp"

#include "engine/infer/pipeline/reversal_mask.hpp"

namespace torquescope {

std::vector<std::vector<bool>> samples_one_way(ArmModel const& model, std::vector<Motion> const& motion,
                                               double cutoff_hz) {
  std::vector<std::vector<bool>> motors, joints;
  for (std::size_t m = 0; m < motion.size(); ++m) {
    bool const is_coupled = model.chain().is_coupled(static_cast<Eigen::Index>(m));
    Eigen::VectorXd const speed = is_coupled ? model.motor_motion(motion, m).dq : motion[m].dq;
    motors.push_back(moving_samples(speed, motion[m].rate_hz, cutoff_hz));
  }
  for (std::size_t j = 0; j < motion.size(); ++j) {
    std::vector<bool> all(motors[j].size(), true);
    for (std::size_t const m : model.motors_of_joint(j))
      for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] && motors[m][i];
    joints.push_back(std::move(all));
  }
  return joints;
}

}  // namespace torquescope
