// What other joints and a wrong robot file do to a joint: against the inverse dynamics of an arm that really has it.

#include "engine/diagnose/arms/arm_effects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "engine/effects/given_effect.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/vector3.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace arm_effects_test {

constexpr Eigen::Index samples = 40;

SerialChain three_joints_or_more() {
  for (std::uint32_t number = 1;; ++number)
    if (auto chain = test::random_arm(number, false, true).chain; chain.joints.size() > 2) {
      chain.flange.position = {0.1, -0.2, 0.3};
      return chain;
    }
}

class ArmEffects : public testing::Test {
 protected:
  ArmEffects() {
    for (std::size_t j = 0; j < chain.joints.size(); ++j) {
      Eigen::ArrayXd const t = Eigen::ArrayXd::LinSpaced(samples, 0.0, 2.0 + static_cast<double>(j));
      Motion one;
      one.q = (1.3 * t).sin();
      one.dq = 1.3 * (1.3 * t).cos();
      one.ddq = -1.69 * (1.3 * t).sin();
      motion.push_back(std::move(one));
    }
    signals = arm_effect_signals(model, motion);
    of_the_arm = whole_arm_effects(model, model.base().from_standard(standard), motion, arm_effect_choices());
  }

  // n x L of one joint
  Eigen::MatrixXd const& columns_of(std::string const& effect, std::size_t joint,
                                    std::optional<std::size_t> whose = {}) const {
    auto const found = std::find_if(of_the_arm.begin(), of_the_arm.end(), [&](WholeArmEffect const& one) {
      return one.effect->name() == effect && one.joint == whose;
    });
    if (found == of_the_arm.end()) throw std::out_of_range(effect);
    return found->columns[joint];
  }

  // what joint j needs more, arm and motion given as they would be with the effect
  double more(SerialChain const& with, Eigen::VectorXd const& parameters, Eigen::Index i, Eigen::Index j) const {
    Eigen::VectorXd const q = at(&Motion::q, i), dq = at(&Motion::dq, i), ddq = at(&Motion::ddq, i);
    return inverse_dynamics(with, parameters, q, dq, ddq)[j] - inverse_dynamics(chain, standard, q, dq, ddq)[j];
  }

  Eigen::VectorXd at(Eigen::VectorXd Motion::*what, Eigen::Index i) const {
    Eigen::VectorXd all(static_cast<Eigen::Index>(motion.size()));
    for (std::size_t j = 0; j < motion.size(); ++j) all[static_cast<Eigen::Index>(j)] = (motion[j].*what)[i];
    return all;
  }

  Eigen::Vector3d tip_of(Eigen::VectorXd const& q) const {
    FramePose pose;
    for (std::size_t j = 0; j < chain.joints.size(); ++j)
      pose = pose * joint_pose(chain.joints[j], q[static_cast<Eigen::Index>(j)]);
    return (pose * chain.flange).position;
  }

  SerialChain const chain = three_joints_or_more();
  Eigen::VectorXd const standard = standard_parameters(chain, DriveInertias::included);
  ArmModel const model{chain, ArmTerms{}, Section{}};
  std::vector<Motion> motion{};
  std::vector<GivenSignals> signals{};
  std::vector<WholeArmEffect> of_the_arm{};
};

TEST_F(ArmEffects, TakeTheNeighboursMotionWhereThereIsANeighbour) {
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

// the torque of an arm whose encoder is off by a little, less that of the arm of the file: all joints feel it
TEST_F(ArmEffects, SayWhatAWrongZeroDoes) {
  constexpr double zero = 1e-4;
  for (std::size_t whose = 0; whose < motion.size(); ++whose) {
    if (chain.joints[whose].kind != JointKind::revolute) continue;
    SerialChain wrong = chain;
    wrong.joints[whose].offset += zero;
    for (std::size_t j = 0; j < motion.size(); ++j) {
      auto const& column = columns_of("joint_zero", j, whose);
      for (Eigen::Index i = 0; i < samples; ++i) {
        double const slope = more(wrong, standard, i, static_cast<Eigen::Index>(j)) / zero;
        EXPECT_NEAR(column(i, 0), slope, 1e-2 * (1.0 + std::abs(slope))) << whose << ' ' << j << ' ' << i;
      }
    }
  }
}

// the torque of an arm whose last body is heavier, less that of the arm of the file
TEST_F(ArmEffects, SayWhatAPayloadOfTheLastLinkDoes) {
  auto const last = static_cast<Eigen::Index>(chain.joints.size()) - 1;
  for (Eigen::Index k = 0; k < numbers_per_link; ++k) {
    Eigen::VectorXd heavier = standard;
    heavier[numbers_per_link * last + k] += 0.7;
    for (std::size_t j = 0; j < motion.size(); ++j)
      for (Eigen::Index i = 0; i < samples; ++i) {
        double const torque = more(chain, heavier, i, static_cast<Eigen::Index>(j));
        EXPECT_NEAR(0.7 * columns_of("payload_picked_up", j)(i, k), torque, 1e-9 * (1.0 + std::abs(torque)))
            << link_number_names[static_cast<std::size_t>(k)] << ' ' << j;
      }
  }
}

// the work of the force on the tip's way is that of the joints: -J' F by differences of the tip's place
TEST_F(ArmEffects, SayWhatAForceOnTheTipDoes) {
  constexpr double step = 1e-6;
  for (Eigen::Index i = 0; i < samples; i += 7)
    for (std::size_t j = 0; j < motion.size(); ++j) {
      Eigen::VectorXd ahead = at(&Motion::q, i), behind = ahead;
      ahead[static_cast<Eigen::Index>(j)] += step;
      behind[static_cast<Eigen::Index>(j)] -= step;
      Eigen::Vector3d const slope = (tip_of(ahead) - tip_of(behind)) / (2.0 * step);
      for (Eigen::Index k = 0; k < 3; ++k)
        EXPECT_NEAR(columns_of("tip_contact", j)(i, k), -slope[k], 1e-6 * (1.0 + std::abs(slope[k]))) << j << ' ' << k;
    }
}

// of joints that carry weight as it is: what one can know of the others says nothing of their weight
TEST_F(ArmEffects, SayWhatATiltedBaseDoes) {
  constexpr double tilt = 1e-4;
  Eigen::Vector3d const aside = cross(chain.gravity, Eigen::Vector3d(0.3, -0.5, 0.8));
  Eigen::Vector3d const directions[2] = {aside, cross(chain.gravity, aside) / chain.gravity.norm()};
  int weighed = 0;
  for (Eigen::Index j = 0; j < static_cast<Eigen::Index>(motion.size()); ++j) {
    if (std::abs(gravity_torque(chain, standard, at(&Motion::q, 7))[j]) < 1e-9) continue;
    ++weighed;
    Eigen::MatrixXd const& columns = columns_of("gravity_direction", static_cast<std::size_t>(j));
    Eigen::MatrixXd felt(samples, 2);
    for (Eigen::Index k = 0; k < 2; ++k) {
      SerialChain tilted = chain;
      // any two directions at right angles to gravity span the same columns
      tilted.gravity += tilt * directions[k];
      for (Eigen::Index i = 0; i < samples; ++i)
        felt(i, k) = (gravity_torque(tilted, standard, at(&Motion::q, i)) -
                      gravity_torque(chain, standard, at(&Motion::q, i)))[j] /
                     tilt;
    }
    // the same plane: each is a combination of the others
    Eigen::MatrixXd const gram = columns.transpose() * columns;
    Eigen::Matrix2d inverse;
    inverse << gram(1, 1), -gram(0, 1), -gram(1, 0), gram(0, 0);
    inverse /= gram(0, 0) * gram(1, 1) - gram(0, 1) * gram(1, 0);
    Eigen::MatrixXd const left = felt - columns * (inverse * (columns.transpose() * felt));
    EXPECT_LT(left.norm(), 1e-6 * felt.norm()) << j;
  }
  EXPECT_GT(weighed, 0);
}

// links that move as told, and what they need
struct LinksOnTheWay {
  std::vector<Motion> motion{};
  Eigen::MatrixXd load{};  // n x N
};

Eigen::VectorXd torque_of(SerialChain const& chain, Eigen::VectorXd const& parameters,
                          std::vector<Motion> const& motion, Eigen::Index sample) {
  Eigen::MatrixXd at(static_cast<Eigen::Index>(motion.size()), 3);
  for (std::size_t j = 0; j < motion.size(); ++j)
    at.row(static_cast<Eigen::Index>(j)) << motion[j].q[sample], motion[j].dq[sample], motion[j].ddq[sample];
  return inverse_dynamics(chain, parameters, at.col(0), at.col(1), at.col(2));
}

LinksOnTheWay links_on_the_way(SerialChain const& chain, Eigen::VectorXd const& standard, Eigen::Index n,
                               double rate_hz) {
  auto const joints = static_cast<Eigen::Index>(chain.joints.size());
  LinksOnTheWay links;
  for (Eigen::Index j = 0; j < joints; ++j) {
    double const w = 3.0 + static_cast<double>(j);
    Eigen::ArrayXd const phase = w / rate_hz * Eigen::ArrayXd::LinSpaced(n, 0.0, static_cast<double>(n - 1)) + 0.3;
    Motion one;
    one.rate_hz = rate_hz;
    one.q = phase.sin();
    one.dq = w * phase.cos();
    one.ddq = -w * w * phase.sin();
    links.motion.push_back(std::move(one));
  }
  links.load.resize(n, joints);
  for (Eigen::Index i = 0; i < n; ++i)
    links.load.row(i) = torque_of(chain, standard.head(numbers_per_link * joints), links.motion, i);
  return links;
}

// one joint winds up: what all drives need, less what the arm of the file needs for the motion that encoders see
TEST_F(ArmEffects, SayWhatAJointThatWindsUpDoes) {
  constexpr double rate_hz = 2000.0, compliance = 1e-7;
  constexpr Eigen::Index n = 400, edge = 5;
  auto const joints = static_cast<Eigen::Index>(chain.joints.size());
  LinksOnTheWay const links = links_on_the_way(chain, standard, n, rate_hz);
  Eigen::VectorXd const drives = standard.tail(joints);
  for (Eigen::Index whose = 0; whose < joints; ++whose) {
    std::vector<Motion> seen = links.motion;
    Motion& own = seen[static_cast<std::size_t>(whose)];
    Eigen::VectorXd const wound = compliance * links.load.col(whose), speed = central_derivative(wound, rate_hz);
    own.q += wound;
    own.dq += speed;
    own.ddq += central_derivative(speed, rate_hz);
    Eigen::MatrixXd needed = links.load;
    for (Eigen::Index i = 0; i < n; ++i) needed.row(i) -= torque_of(chain, standard, seen, i);
    auto const effects = whole_arm_effects(model, model.base().from_standard(standard), seen, arm_effect_choices());
    auto const effect = std::find_if(effects.begin(), effects.end(), [&](WholeArmEffect const& one) {
      return one.effect->name() == "joint_compliance" && one.joint == static_cast<std::size_t>(whose);
    });
    ASSERT_NE(effect, effects.end());
    for (Eigen::Index j = 0; j < joints; ++j) {
      auto const& columns = effect->columns[static_cast<std::size_t>(j)];
      needed.col(j) += drives[j] * seen[static_cast<std::size_t>(j)].ddq;
      double const drive = drives[whose];
      Eigen::Vector3d const parameters = compliance * Eigen::Vector3d(1.0, drive, drive * drive);
      Eigen::VectorXd const apart = needed.col(j) - columns * parameters.head(columns.cols());
      auto const inside = [&](auto const& of) { return of.segment(edge, n - 2 * edge).norm(); };
      EXPECT_LT(inside(apart), 1e-3 * inside(needed.col(j)) + 1e-12) << whose << ' ' << j;
    }
  }
}

TEST_F(ArmEffects, AreThoseOfTheCatalogue) {
  for (auto const* effect : arm_effect_choices()) {
    EXPECT_TRUE(effect->is_given());
    EXPECT_EQ(find_effect(effect->name()), effect);
    EXPECT_FALSE(effect->is_plain_term()) << "no term of a model";
    if (effect->is_of_whole_arm()) {
      EXPECT_EQ(signals[1].of(effect->name()), nullptr) << "no effect of one joint";
      continue;
    }
    Eigen::MatrixXd const* columns = signals[1].of(effect->name());
    ASSERT_NE(columns, nullptr) << effect->name();
    Eigen::MatrixXd out(samples, static_cast<Eigen::Index>(effect->n_linear()));
    EffectInput input{motion[1]};
    effect->columns(input, {}, out);
    EXPECT_EQ(out.norm(), 0.0) << "no recording tells of it";
    input.given = &signals[1];
    effect->columns(input, {}, out);
    EXPECT_EQ(out, *columns);
  }
}

}  // namespace arm_effects_test
}  // namespace torquescope
