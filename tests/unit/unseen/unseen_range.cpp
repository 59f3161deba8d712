// Names that an unseen recording speaks against only where it goes beyond the training motion. The joint has gravity,
// which a narrow motion cannot tell from a spring; half a turn further the spring is absurd.

#include "engine/unseen/unseen_range.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "engine/search/joint_refinement.hpp"
#include "unit/twin/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace unseen_range_test {

class UnseenRange : public testing::Test {
 protected:
  enum class Gravity {
    down,
    mirrored
  };  // about the middle of the narrow motion: the same there, its slope the opposite

  static Recording with_gravity(Gravity gravity, double amplitude, std::uint32_t index) {
    bool const is_down = gravity == Gravity::down;
    auto joint = clean_joint();
    joint.plan.reference.amplitude = amplitude;
    joint.plan.reference.centre = amplitude > 1.0 ? middle + 1.0 : middle;
    joint.plan.plant = plant({{"inertia", joint.truth[0]},
                              {"viscous", joint.truth[1]},
                              {"coulomb", joint.truth[2]},
                              {"offset", joint.truth[3]},
                              {"gravity_sin", is_down ? torque : -torque * std::cos(2.0 * middle)},
                              {"gravity_cos", is_down ? 0.0 : torque * std::sin(2.0 * middle)}});
    return recorded(simulate_joint(joint.plan, index));
  }

  // as if the search had named a spring
  void SetUp() override {
    auto first = make_stage(setting, clean_regressor()).value();
    AcceptedEffect accepted;
    accepted.effect = find_effect("spring");
    selection.accepted.push_back(accepted);
    selection.final =
        std::make_shared<ModelStage const>(refined_stage(setting, first.reference(), {{accepted.effect, {}}}).value());
    selection.baseline = std::make_shared<ModelStage const>(std::move(first));
  }

  bool is_refuted_by(Recording const& unseen) const {
    UnseenSum sum;
    sum.add(check_unseen(unseen, setting, *selection.baseline, *selection.final));
    return speak_against(sum.energies());
  }

  auto only_beyond(Recording const& unseen) const {
    return spoils_only_beyond(setting, std::span(&unseen, 1), selection);
  }

  static constexpr double torque = 2.0, middle = 1.1, narrow = 0.4, wide = 3.0;
  Recording const recording = with_gravity(Gravity::down, narrow, 1);
  FilterOptions const filter = clean_filter();
  Section const section{};
  StageSetting const setting{recording, clean_regressor(), filter, section, 64, 1, 2};
  Selection selection{};
};

TEST_F(UnseenRange, TellsALawThatHoldsWhereItWasFound) {
  Recording const unseen = with_gravity(Gravity::down, wide, 2);
  ASSERT_TRUE(is_refuted_by(unseen));
  auto const trained = only_beyond(unseen);
  ASSERT_TRUE(trained.has_value());
  EXPECT_NEAR(trained->most_position, recording.position.maxCoeff(), 0.1 * narrow);
  EXPECT_NEAR(trained->least_position, recording.position.minCoeff(), 0.1 * narrow);
}

TEST_F(UnseenRange, SavesNoLawThatDoesNotHoldThereEither) {
  Recording const of_another = with_gravity(Gravity::mirrored, wide, 2);
  ASSERT_TRUE(is_refuted_by(of_another));
  EXPECT_FALSE(only_beyond(of_another).has_value());
}

TEST_F(UnseenRange, IsNoExcuseWhereTheMotionIsTheSame) {
  EXPECT_FALSE(only_beyond(with_gravity(Gravity::mirrored, narrow, 2)).has_value());
}

TEST_F(UnseenRange, CountsRowsWithinAMarginOfATwentieth) {
  auto const& pipeline = *selection.final->pipeline;
  auto const& record = selection.final->comparison.recording;
  MotionRange range = range_of(record, pipeline);
  EXPECT_EQ(rows_within(range, record, pipeline), record.kept_rows);
  Eigen::VectorXd const q = pipeline.picked(record.motion.q, record), dq = pipeline.picked(record.motion.dq, record);
  range.least_position = middle;
  double const least = middle - 0.05 * (range.most_position - middle), most = -0.05 * range.least_velocity;
  auto const n_rows = [&] { return static_cast<Eigen::Index>(rows_within(range, record, pipeline).size()); };
  EXPECT_EQ(n_rows(), (q.array() >= least).count());
  EXPECT_LT(n_rows(), q.size());
  range.most_velocity = 0.0;
  EXPECT_EQ(n_rows(), (q.array() >= least && dq.array() <= most).count());
}

}  // namespace unseen_range_test
