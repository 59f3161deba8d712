// What other joints and a wrong robot file do to a joint: against the inverse dynamics of an arm that really has it.

#include "engine/diagnose/arm_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/effects/given_effect.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/vector3.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace arm_laws_test {

constexpr Eigen::Index samples = 40;

SerialChain three_joints_or_more() {
  for (std::uint32_t number = 1;; ++number)
    if (auto chain = test::random_arm(number, false, true).chain; chain.joints.size() > 2) return chain;
}

class ArmLaws : public testing::Test {
 protected:
  ArmLaws() {
    for (std::size_t j = 0; j < chain.joints.size(); ++j) {
      Eigen::ArrayXd const t = Eigen::ArrayXd::LinSpaced(samples, 0.0, 2.0 + static_cast<double>(j));
      Motion one;
      one.q = (1.3 * t).sin();
      one.dq = 1.3 * (1.3 * t).cos();
      one.ddq = -1.69 * (1.3 * t).sin();
      motion.push_back(std::move(one));
    }
    Eigen::VectorXd const parameters = model.base().from_standard(standard);
    signals = arm_law_signals(model, parameters, motion);
  }

  Eigen::VectorXd at(Eigen::VectorXd Motion::*what, Eigen::Index i) const {
    Eigen::VectorXd all(static_cast<Eigen::Index>(motion.size()));
    for (std::size_t j = 0; j < motion.size(); ++j) all[static_cast<Eigen::Index>(j)] = (motion[j].*what)[i];
    return all;
  }

  SerialChain const chain = three_joints_or_more();
  Eigen::VectorXd const standard = standard_parameters(chain, DriveInertias::included);
  ArmModel const model{chain, ArmTerms{}, Section{}};
  std::vector<Motion> motion{};
  std::vector<GivenSignals> signals{};
};

TEST_F(ArmLaws, TakeTheNeighboursMotionWhereThereIsANeighbour) {
  EXPECT_EQ(signals[0].of("friction_of_previous_joint"), nullptr);
  EXPECT_EQ(signals.back().of("inertia_of_next_joint"), nullptr);
  auto const* friction = signals[0].of("friction_of_next_joint");
  ASSERT_NE(friction, nullptr);
  EXPECT_EQ(friction->col(0), motion[1].dq);
  EXPECT_EQ(friction->col(1), motion[1].dq.array().sign().matrix());
  auto const* inertia = signals[2].of("inertia_of_previous_joint");
  ASSERT_NE(inertia, nullptr);
  EXPECT_EQ(inertia->col(0), motion[1].ddq);
}

// the torque of an arm whose encoder is off by a little, less that of the arm of the file
TEST_F(ArmLaws, SayWhatAWrongZeroDoes) {
  constexpr double zero = 1e-4;
  for (Eigen::Index j = 0; j < static_cast<Eigen::Index>(motion.size()); ++j) {
    auto const* column = signals[static_cast<std::size_t>(j)].of("joint_zero");
    ASSERT_NE(column, nullptr);
    SerialChain wrong = chain;
    wrong.joints[static_cast<std::size_t>(j)].offset += zero;
    for (Eigen::Index i = 0; i < samples; ++i) {
      Eigen::VectorXd const q = at(&Motion::q, i), dq = at(&Motion::dq, i), ddq = at(&Motion::ddq, i);
      if (chain.joints[static_cast<std::size_t>(j)].kind != JointKind::revolute) continue;
      double const more =
          inverse_dynamics(wrong, standard, q, dq, ddq)[j] - inverse_dynamics(chain, standard, q, dq, ddq)[j];
      EXPECT_NEAR((*column)(i, 0), more / zero, 1e-2 * (1.0 + std::abs(more / zero))) << j << ' ' << i;
    }
  }
}

// of joints that carry weight as it is: what one can know of the others says nothing of their weight
TEST_F(ArmLaws, SayWhatATiltedBaseDoes) {
  constexpr double tilt = 1e-4;
  Eigen::Vector3d const aside = cross(chain.gravity, Eigen::Vector3d(0.3, -0.5, 0.8));
  Eigen::Vector3d const directions[2] = {aside, cross(chain.gravity, aside) / chain.gravity.norm()};
  int weighed = 0;
  for (Eigen::Index j = 0; j < static_cast<Eigen::Index>(motion.size()); ++j) {
    if (std::abs(gravity_torque(chain, standard, at(&Motion::q, 7))[j]) < 1e-9) continue;
    ++weighed;
    auto const* columns = signals[static_cast<std::size_t>(j)].of("gravity_direction");
    ASSERT_NE(columns, nullptr);
    Eigen::MatrixXd more(samples, 2);
    for (Eigen::Index k = 0; k < 2; ++k) {
      SerialChain tilted = chain;
      // any two directions at right angles to gravity span the same columns
      tilted.gravity += tilt * directions[k];
      for (Eigen::Index i = 0; i < samples; ++i)
        more(i, k) = (gravity_torque(tilted, standard, at(&Motion::q, i)) -
                      gravity_torque(chain, standard, at(&Motion::q, i)))[j] /
                     tilt;
    }
    // the same plane: each is a combination of the others
    Eigen::MatrixXd const gram = columns->transpose() * *columns;
    Eigen::Matrix2d inverse;
    inverse << gram(1, 1), -gram(0, 1), -gram(1, 0), gram(0, 0);
    inverse /= gram(0, 0) * gram(1, 1) - gram(0, 1) * gram(1, 0);
    Eigen::MatrixXd const left = more - *columns * (inverse * (columns->transpose() * more));
    EXPECT_LT(left.norm(), 1e-6 * more.norm()) << j;
  }
  EXPECT_GT(weighed, 0);
}

TEST_F(ArmLaws, AreThoseOfTheCatalogue) {
  for (auto const* law : arm_law_choices()) {
    EXPECT_TRUE(law->is_given());
    EXPECT_EQ(find_effect(law->name()), law);
    Eigen::MatrixXd const* columns = signals[1].of(law->name());
    ASSERT_NE(columns, nullptr) << law->name();
    Eigen::MatrixXd out(samples, static_cast<Eigen::Index>(law->n_linear()));
    EffectInput input{motion[1]};
    law->columns(input, {}, out);
    EXPECT_EQ(out.norm(), 0.0) << "no recording tells of it";
    input.given = &signals[1];
    law->columns(input, {}, out);
    EXPECT_EQ(out, *columns);
    EXPECT_FALSE(law->is_plain_term()) << "no term of a model";
  }
}

}  // namespace arm_laws_test
}  // namespace torquescope
