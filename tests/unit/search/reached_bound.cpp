// A parameter that ends where it could not go further is no finding: the law is none of the catalogue. Bounds that are
// laws themselves are.

#include "engine/search/reached_bound.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/search/shape_refinement.hpp"
#include "unit/twin/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace reached_bound_test {

JointScales scales() {
  JointScales made;
  made.duration_s = 10.0;
  made.peak_speed = 3.0;
  made.position_range = 2.0;
  made.encoder_step = 1e-4;
  made.coulomb_positive = made.coulomb_negative = 1.0;
  made.torque_highest = made.torque_lowest = 2.0;
  return made;
}

std::optional<ReachedBound> bound_of(char const* name, std::vector<double> const& shape,
                                     std::vector<double> const& linear) {
  return reached_bound(*find_effect(name), shape,
                       Eigen::Map<Eigen::VectorXd const>(linear.data(), static_cast<Eigen::Index>(linear.size())),
                       scales());
}

TEST(ReachedBound, IsTheEndOfWhatIsPlausible) {
  auto const bound = bound_of("presliding", {1e-4}, {0.5, 0.0});
  ASSERT_TRUE(bound.has_value());
  EXPECT_EQ(bound->side, BoundSide::lower);
  EXPECT_EQ(bound->parameter, 2U);
  std::string const words = bound_words(*find_effect("presliding"), *bound, JointKind::revolute);
  EXPECT_NE(words.find("presliding distance ends at the least it can be"), std::string::npos) << words;
  EXPECT_EQ(bound_of("presliding", {0.04}, {0.5, 0.0})->side, BoundSide::upper);
  EXPECT_FALSE(bound_of("presliding", {1e-3}, {0.5, 0.0}).has_value());
  EXPECT_EQ(bound_of("directional_efficiency", {2.0, 1.0}, {0.1})->parameter, 1U);
  EXPECT_EQ(bound_of("load_dependent_friction", {1.0, 0.0}, {0.3})->parameter, 0U)
      << "a linear one with a bound of its own";
}

TEST(ReachedBound, IsNoneWhereTheBoundIsALaw) {
  EXPECT_FALSE(bound_of("presliding", {1e-3}, {1.0, 0.0}).has_value()) << "all of the Coulomb friction builds up";
  EXPECT_FALSE(bound_of("stribeck", {0.1, 2.0}, {0.5}).has_value()) << "a bell";
  EXPECT_FALSE(bound_of("end_stop", {0.2, 1.0}, {5.0, 0.0}).has_value()) << "a spring";
  EXPECT_FALSE(bound_of("load_dependent_friction", {1.0, 0.0}, {0.1}).has_value()) << "all inertia behind the gear";
  EXPECT_FALSE(bound_of("clipping", {2.0, 2.0}, {1.0}).has_value());
  EXPECT_FALSE(bound_of("joint_elasticity", {30.0, 0.05, 0.0}, {0.01}).has_value()) << "a spring that does not harden";
}

// a spring's rest is an offset, which the model has: wherever it stands, it explains the same
class FittedToBound : public testing::Test {
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

TEST_F(FittedToBound, IsNoneWhereTheDataDoNotMind) {
  FilterOptions const filter = clean_filter();
  Section const section{};
  // a linear spring
  {
    Recording const recording = recording_with("spring", 0.3, [](JointScales const&) { return std::vector{0.0, 0.0}; });
    StageSetting const setting{recording, clean_regressor(), filter, section, 24, 1, 2};
    ModelStage const stage = make_stage(setting, clean_regressor()).value();
    CandidateColumns const columns(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters());
    Effect const& spring = *find_effect("spring");
    double const end = spring.shape_bounds(columns.scales())[1].upper;
    Eigen::VectorXd const linear = Eigen::VectorXd::Constant(1, 0.3);
    ASSERT_TRUE(reached_bound(spring, std::vector<double>{0.0, end}, linear, columns.scales()).has_value());
    EXPECT_FALSE(fitted_to_bound(columns, spring, std::vector<double>{0.0, end}, linear, stage.mismatch()).has_value());
  }
}

// friction that falls over more of the speeds than a Stribeck law may: the bound is told, and not where the law fits
TEST_F(FittedToBound, IsToldWhereTheBestLawLiesBeyond) {
  FilterOptions const filter = clean_filter();
  Section const section{};
  for (auto const& [speed, is_beyond] : {std::pair(0.6, true), std::pair(0.05, false)}) {
    Recording const recording = recording_with("stribeck", 0.5, [&, &speed = speed](JointScales const& own) {
      return std::vector{speed * own.peak_speed, 1.0};
    });
    StageSetting const setting{recording, clean_regressor(), filter, section, 24, 1, 2};
    ModelStage const stage = make_stage(setting, clean_regressor()).value();
    CandidateColumns const columns(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters());
    Effect const& stribeck = *find_effect("stribeck");
    std::vector<double> const at_bound{stribeck.shape_bounds(columns.scales())[0].upper, 1.0};
    Eigen::VectorXd const linear = Eigen::VectorXd::Constant(1, 0.3);
    ASSERT_TRUE(reached_bound(stribeck, at_bound, linear, columns.scales()).has_value());
    EXPECT_EQ(fitted_to_bound(columns, stribeck, at_bound, linear, stage.mismatch()).has_value(), is_beyond) << speed;
  }
}

}  // namespace reached_bound_test
