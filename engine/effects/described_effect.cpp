#include "engine/effects/described_effect.hpp"

#include "engine/base/contract.hpp"

namespace torquescope {

void SingleColumnEffect::columns(Motion const& motion, std::span<double const> shape,
                                 Eigen::Ref<Eigen::MatrixXd> out) const {
  TORQUESCOPE_EXPECT(shape.empty());
  TORQUESCOPE_EXPECT(out.rows() == motion.q.size() && out.cols() == 1);
  for (Eigen::Index i = 0; i < motion.q.size(); ++i)
    out(i, 0) = column({motion.time_s[i], motion.q[i], motion.dq[i], motion.ddq[i]});
}

double SingleColumnEffect::torque(JointState const& state, std::span<double const> parameters) const {
  TORQUESCOPE_EXPECT(parameters.size() == 1);
  return parameters[0] * column(state);
}

}  // namespace torquescope
