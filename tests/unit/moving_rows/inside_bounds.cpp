// A shape at the end of what is plausible: moved inside where the data do not mind, told where the best law lies
// beyond.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "engine/infer/moving_rows/refined_candidates.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace inside_bounds_test {

// a spring's rest is an offset, which the model has: wherever it stands, it explains the same
class BoundsOfAFit : public testing::Test {
 protected:
  // shape: of the scales of the recording itself
  template <class Shape>
  static Recording recording_with(std::string const& name, double value, Shape const& shape_of) {
    auto joint = clean_joint();
    Effect const& effect = *find_effect(name);
    Recording recording = recorded(simulate_joint(joint.plan, 3));
    Motion const motion = differentiate(recording, clean_filter(), {});
    Eigen::MatrixXd column(motion.q.size(), static_cast<Eigen::Index>(effect.n_linear()));
    JointScales const own = measure_scales(motion, JointKind::revolute, 30.0, recording.rows.encoder_step);
    std::vector<double> const shape = shape_of(own);
    effect.columns({motion, own}, shape, column);
    recording.torque += value * column.col(0);
    return recording;
  }
};

TEST_F(BoundsOfAFit, IsNoneWhereTheDataDoNotMind) {
  FilterOptions const filter = clean_filter();
  Section const section{};
  // a linear spring
  {
    Recording const recording = recording_with("spring", 0.3, [](JointScales const&) { return std::vector{0.0, 0.0}; });
    StageSetting const setting{recording, clean_regressor(), filter, section, 24, 1, 2};
    ModelStage const stage = make_stage(setting, clean_regressor()).value();
    Evidence const evidence(setting, stage, {});
    CandidateColumns const& columns = evidence.columns();
    Effect const& spring = *find_effect("spring");
    double const end = spring.shape_bounds(columns.scales())[1].upper;
    Eigen::VectorXd const linear = Eigen::VectorXd::Constant(1, 0.3);
    ASSERT_TRUE(reached_bound(spring, std::vector<double>{0.0, end}, linear, columns.scales()).has_value());
    InsideBounds const inside = inside_bounds(evidence, spring, {0.0, end}, linear, FoldKind::whole, DrivenBy::twin);
    EXPECT_FALSE(inside.bound.has_value());
    EXPECT_LT(inside.shape[1], end) << "it is moved inside";
  }
}

// friction that falls over more of the speeds than a Stribeck law may: the bound is told, and not where the law fits
TEST_F(BoundsOfAFit, IsToldWhereTheBestLawLiesBeyond) {
  FilterOptions const filter = clean_filter();
  Section const section{};
  for (auto const& [speed, is_beyond] : {std::pair(0.6, true), std::pair(0.05, false)}) {
    Recording const recording = recording_with("stribeck", 0.5, [&, &speed = speed](JointScales const& own) {
      return std::vector{speed * own.peak_speed, 1.0};
    });
    StageSetting const setting{recording, clean_regressor(), filter, section, 24, 1, 2};
    ModelStage const stage = make_stage(setting, clean_regressor()).value();
    Evidence const evidence(setting, stage, {});
    CandidateColumns const& columns = evidence.columns();
    Effect const& stribeck = *find_effect("stribeck");
    std::vector<double> const at_bound{stribeck.shape_bounds(columns.scales())[0].upper, 1.0};
    Eigen::VectorXd const linear = Eigen::VectorXd::Constant(1, 0.3);
    ASSERT_TRUE(reached_bound(stribeck, at_bound, linear, columns.scales()).has_value());
    InsideBounds const inside = inside_bounds(evidence, stribeck, at_bound, linear, FoldKind::whole, DrivenBy::twin);
    EXPECT_EQ(inside.bound.has_value(), is_beyond) << speed;
  }
}

}  // namespace inside_bounds_test
