// Weight of an eccentric link: any direction of the centre of mass, any zero of the angle.
//
// Equation   tau = g_sin sin(q) + g_cos cos(q)
// Errors     none here; the regressor refuses it for a prismatic joint, whose weight is a constant (offset)
// Source     Khalil, Dombre 2002, Modeling, Identification and Control of Robots; PHYSICS.md G1

#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/effects/described_effect.hpp"

namespace torquescope::effects {
namespace {

class Gravity final : public DescribedEffect {
 public:
  Gravity()
      : DescribedEffect({"gravity",
                         "weight of an eccentric link",
                         "g_sin sin(q) + g_cos cos(q)",
                         "Khalil, Dombre 2002, Modeling, Identification and Control of Robots",
                         {{"gravity_sin", "N m", ""}, {"gravity_cos", "N m", ""}}}) {}

  void columns(Motion const& motion, std::span<double const> shape, Eigen::Ref<Eigen::MatrixXd> out) const override {
    TORQUESCOPE_EXPECT(shape.empty());
    TORQUESCOPE_EXPECT(out.rows() == motion.q.size() && out.cols() == 2);
    for (Eigen::Index i = 0; i < motion.q.size(); ++i) {
      out(i, 0) = std::sin(motion.q[i]);
      out(i, 1) = std::cos(motion.q[i]);
    }
  }

  double torque(JointState const& state, std::span<double const> parameters) const override {
    TORQUESCOPE_EXPECT(parameters.size() == 2);
    return parameters[0] * std::sin(state.q) + parameters[1] * std::cos(state.q);
  }
};

}  // namespace

Effect const& gravity() {
  static Gravity const effect;
  return effect;
}

}  // namespace torquescope::effects
