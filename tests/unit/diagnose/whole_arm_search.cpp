// Effects of a whole arm, concealed in recordings of arms whose inverse dynamics is the test's own sum of what they
// feel.

#include "engine/diagnose/arm_masses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/effects/given_effect.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/vector3.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace whole_arm_search_test {

constexpr double rate_hz = 100.0;
constexpr Eigen::Index n = 3000;

SerialChain three_revolute_joints() {
  for (std::uint32_t number = 1;; ++number) {
    auto chain = test::random_arm(number, false, true).chain;
    bool const turns = std::all_of(chain.joints.begin(), chain.joints.end(),
                                   [](ChainJoint const& one) { return one.kind == JointKind::revolute; });
    if (turns && chain.joints.size() == 3) return chain;
  }
}

// what the machine has and the model has not
struct Truth {
  SerialChain chain{};
  double payload_mass = 0.0;  // at 0.2 m along x of the last link, a point
  double from_s = 0.0, until_s = 0.0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

class WholeArmSearch : public testing::Test {
 protected:
  RecordedArm recorded(Truth const& truth, unsigned number) const {
    std::mt19937 random(number);
    std::normal_distribution<double> noise(0.0, 0.05);
    RecordedArm arm;
    std::size_t const joints = chain.joints.size();
    for (std::size_t j = 0; j < joints; ++j) {
      Recording one;
      one.name = "run" + std::to_string(number) + ".csv";
      one.rate_hz = rate_hz;
      one.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / rate_hz);
      one.position.resize(n);
      one.torque.resize(n);
      arm.joints.push_back(std::move(one));
    }
    Eigen::VectorXd const plain = standard_parameters(chain, DriveInertias::included);
    Eigen::VectorXd const own = plain.head(numbers_per_link * static_cast<Eigen::Index>(joints));
    for (Eigen::Index i = 0; i < n; ++i) {
      double const t = static_cast<double>(i) / rate_hz;
      Eigen::VectorXd q(joints), dq(joints), ddq(joints);
      for (std::size_t j = 0; j < joints; ++j) {
        double const w = 1.1 + 0.7 * static_cast<double>(j), v = 2.3 + 0.4 * static_cast<double>(number + j);
        auto const k = static_cast<Eigen::Index>(j);
        q[k] = std::sin(w * t) + 0.3 * std::cos(v * t);
        dq[k] = w * std::cos(w * t) - 0.3 * v * std::sin(v * t);
        ddq[k] = -w * w * std::sin(w * t) - 0.3 * v * v * std::cos(v * t);
      }
      bool const is_acting = t >= truth.from_s && t < truth.until_s;
      Eigen::VectorXd with = own;
      if (is_acting && truth.payload_mass > 0.0) {
        LinkInertia const load = LinkInertia::from_centre(truth.payload_mass, {0.2, 0.0, 0.0}, Eigen::Matrix3d::Zero());
        with.tail(numbers_per_link) += load.vector();
      }
      Eigen::VectorXd tau = inverse_dynamics(truth.chain, with, q, dq, ddq);
      if (is_acting) tau -= jacobian(q).transpose() * truth.force;
      for (std::size_t j = 0; j < joints; ++j) {
        auto const k = static_cast<Eigen::Index>(j);
        arm.joints[j].position[i] = q[k];
        arm.joints[j].torque[i] = tau[k] + 0.4 * dq[k] + std::copysign(0.5, dq[k]) + noise(random);
      }
    }
    return arm;
  }

  Eigen::MatrixXd jacobian(Eigen::VectorXd const& q) const {
    Eigen::MatrixXd slopes(3, q.size());
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      Eigen::VectorXd ahead = q, behind = q;
      ahead[j] += 1e-6;
      behind[j] -= 1e-6;
      slopes.col(j) = (tip_of(ahead) - tip_of(behind)) / 2e-6;
    }
    return slopes;
  }

  Eigen::Vector3d tip_of(Eigen::VectorXd const& q) const {
    FramePose pose;
    for (std::size_t j = 0; j < chain.joints.size(); ++j)
      pose = pose * joint_pose(chain.joints[j], q[static_cast<Eigen::Index>(j)]);
    return (pose * chain.flange).position;
  }

  WholeArmAnswer answer(std::vector<RecordedArm> const& train, std::vector<RecordedArm> const& validation,
                        int threads = 1) const {
    return found_in(input(train, validation, threads), learnt(input(train, validation, threads)));
  }

  ArmDiagnosisInput input(std::vector<RecordedArm> const& train, std::vector<RecordedArm> const& validation,
                          int threads = 1) const {
    ArmDiagnosisInput asked{model, train, validation, candidates, filter, section};
    asked.seed = 11;
    asked.threads = threads;
    return asked;
  }

  LearntArm learnt(ArmDiagnosisInput const& asked) const {
    std::vector<RecordedArm> arms = asked.train;
    arms.insert(arms.end(), asked.validate.begin(), asked.validate.end());
    return learnt_arm(asked, std::move(arms), {filter, section});
  }

  static WholeArmAnswer found_in(ArmDiagnosisInput const& asked, LearntArm const& arm) {
    return effects_of_whole_arm(asked, {arm.effects, arm.rows, arm.noise()});
  }

  SerialChain const chain = three_revolute_joints();
  ArmModel const model{chain, ArmTerms{{"viscous", "coulomb"}, {}, {}, DriveInertias::left_out}, Section{}};
  FilterOptions const filter = [] {
    FilterOptions options;
    options.cutoff_hz = 20.0;
    options.parallel_cutoff_hz = 8.0;
    options.decimate_to_hz = 25.0;
    return options;
  }();
  Section const section{};
  std::vector<std::vector<Effect const*>> const candidates{chain.joints.size(), arm_effect_choices()};
};

TEST_F(WholeArmSearch, FindsNothingWhereNothingIsMissing) {
  auto const found = answer({recorded({chain}, 1)}, {recorded({chain}, 2)});
  EXPECT_TRUE(found.accepted.empty());
  EXPECT_FALSE(found.tried.empty());
}

TEST_F(WholeArmSearch, FindsAPayloadItsInstantAndItsParameters) {
  Truth const truth{chain, 1.5, 11.0, 1e9};
  auto const found = answer({recorded(truth, 1)}, {recorded({chain}, 2)});
  ASSERT_EQ(found.accepted.size(), 1u);
  auto const& one = found.accepted.front();
  EXPECT_EQ(one.effect.effect->name(), "payload_picked_up");
  ASSERT_TRUE(one.time);
  EXPECT_NEAR(one.time->from_s, 11.0, 0.1);
  EXPECT_TRUE(std::isinf(one.time->until_s));
  EXPECT_TRUE(one.is_told[1]);
  EXPECT_NEAR(one.values[1], 1.5 * 0.2, 4.0 * one.errors[1] + 1e-3);
  EXPECT_NEAR(one.values[2], 0.0, 4.0 * one.errors[2] + 1e-3);
  EXPECT_GT(one.explained, 0.9);
  ASSERT_EQ(one.validation_times.size(), 1u);
  EXPECT_FALSE(one.validation_times[0]) << "the other recording is without it";
  EXPECT_LT(one.validation_after, one.validation_before);
}

// picked up at another instant, and put down again
TEST_F(WholeArmSearch, GivesAPayloadInstantsOfItsOwnInValidationRecordings) {
  auto const found = answer({recorded({chain, 1.5, 11.0, 1e9}, 1)},
                            {recorded({chain, 1.5, 19.0, 1e9}, 2), recorded({chain, 1.5, 6.0, 14.0}, 3)});
  ASSERT_EQ(found.accepted.size(), 1u);
  auto const& one = found.accepted.front();
  EXPECT_EQ(one.effect.effect->name(), "payload_picked_up");
  ASSERT_EQ(one.validation_times.size(), 2u);
  ASSERT_TRUE(one.validation_times[0] && one.validation_times[1]);
  EXPECT_NEAR(one.validation_times[0]->from_s, 19.0, 0.15);
  EXPECT_TRUE(std::isinf(one.validation_times[0]->until_s));
  EXPECT_NEAR(one.validation_times[1]->from_s, 6.0, 0.15);
  EXPECT_NEAR(one.validation_times[1]->until_s, 14.0, 0.15);
  EXPECT_LT(one.validation_after, 0.3 * one.validation_before);
}

TEST_F(WholeArmSearch, FindsAForceForAWhile) {
  Truth const truth{chain, 0.0, 8.0, 17.0, {3.0, -4.0, 2.0}};
  auto const found = answer({recorded(truth, 1)}, {});
  ASSERT_EQ(found.accepted.size(), 1u);
  auto const& one = found.accepted.front();
  EXPECT_EQ(one.effect.effect->name(), "tip_contact");
  ASSERT_TRUE(one.time);
  EXPECT_NEAR(one.time->from_s, 8.0, 0.15);
  EXPECT_NEAR(one.time->until_s, 17.0, 0.15);
  for (Eigen::Index k = 0; k < 3; ++k) EXPECT_NEAR(one.values[k], truth.force[k], 4.0 * one.errors[k] + 0.02) << k;
}

TEST_F(WholeArmSearch, FindsATiltedBaseAndAWrongZero) {
  Truth tilted{chain};
  Eigen::Vector3d const aside = cross(chain.gravity, Eigen::Vector3d(0.3, -0.5, 0.8)).normalized();
  tilted.chain.gravity = std::cos(0.06) * chain.gravity + std::sin(0.06) * chain.gravity.norm() * aside;
  auto const of_tilt = answer({recorded(tilted, 1)}, {recorded(tilted, 2)});
  ASSERT_FALSE(of_tilt.accepted.empty());
  EXPECT_EQ(of_tilt.accepted.front().effect.effect->name(), "gravity_direction");
  EXPECT_NEAR(of_tilt.accepted.front().values.norm(), 0.06, 0.006);
  Truth turned{chain};
  turned.chain.joints[1].offset += 0.05;
  auto const of_zero = answer({recorded(turned, 1)}, {recorded(turned, 2)});
  ASSERT_FALSE(of_zero.accepted.empty());
  EXPECT_EQ(of_zero.accepted.front().effect.effect->name(), "joint_zero");
  EXPECT_EQ(of_zero.accepted.front().effect.joint, std::optional<std::size_t>(1));
  EXPECT_NEAR(of_zero.accepted.front().values[0], 0.05, 0.005);
  EXPECT_LT(of_zero.accepted.front().validation_after, 0.5 * of_zero.accepted.front().validation_before);
}

TEST_F(WholeArmSearch, SaysNothingOfAnArmThatStandsStill) {
  RecordedArm still = recorded({chain}, 1);
  for (auto& joint : still.joints) joint.position.setConstant(0.3);
  EXPECT_TRUE(answer({still}, {}).accepted.empty());
}

TEST_F(WholeArmSearch, SaysTheSameForAnyNumberOfThreads) {
  Truth const truth{chain, 1.5, 11.0, 1e9};
  std::vector<RecordedArm> const train{recorded(truth, 1)};
  auto const one = answer(train, {}), two = answer(train, {}, 2);
  ASSERT_EQ(one.tried.size(), two.tried.size());
  for (std::size_t i = 0; i < one.tried.size(); ++i) {
    EXPECT_EQ(one.tried[i].z, two.tried[i].z);
    EXPECT_EQ(one.tried[i].values, two.tried[i].values);
  }
}

TEST_F(WholeArmSearch, TakesOutWhatItFound) {
  Truth const truth{chain, 1.5, 11.0, 1e9};
  std::vector<RecordedArm> const train{recorded(truth, 1)};
  std::vector<RecordedArm> const none{};
  LearntArm const arm = learnt(input(train, none));
  auto const found = found_in(input(train, none), arm);
  auto const left = without_effects(input(train, none), arm.files, {filter, section}, found.accepted);
  RecordedArm const without = recorded({chain}, 1);
  double wrong = 0.0, whole = 0.0;
  for (std::size_t j = 0; j < train[0].joints.size(); ++j) {
    Eigen::VectorXd const really = train[0].joints[j].torque - without.joints[j].torque;
    wrong += (left[0].joints[j].gear_load - really).squaredNorm();
    whole += really.squaredNorm();
  }
  EXPECT_LT(std::sqrt(wrong / whole), 0.05);
}

}  // namespace whole_arm_search_test
}  // namespace torquescope
