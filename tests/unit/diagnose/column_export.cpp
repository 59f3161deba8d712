// What other methods are given: the columns belong to the residual they are to explain, the shape is the one that
// explains most, a validation recording gets the same shapes, and the number of threads leaves no trace.

#include "engine/diagnose/column_export.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/decompositions.hpp"
#include "unit/pipeline/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace column_export_test {

// a joint with Stribeck friction, moved twice
class ColumnExportTest : public testing::Test {
 protected:
  static Recording stribeck_recording(std::uint32_t seed, double duration_s) {
    auto joint = clean_joint();
    joint.plan.simulation.duration_s = duration_s;
    joint.plan.plant = plant({{"inertia", 0.036},
                              {"viscous", 0.164},
                              {"coulomb", 1.3},
                              {"offset", -0.125},
                              {"stribeck", 0.5},
                              {"stribeck_speed", 0.1},
                              {"stribeck_exponent", 1.0}});
    return recorded(simulate_joint(joint.plan, seed));
  }

  ColumnExport exported(int threads) const {
    DiagnosisInput input{train, validate, clean_regressor(), filter, section};
    for (char const* name : {"stribeck", "spring", "cogging", "asymmetric_viscous"})
      input.candidates.push_back(find_effect(name));
    input.threads = threads;
    return export_columns(input);
  }

  Recording const train = stribeck_recording(3, 4.0);
  std::vector<Recording> const validate{stribeck_recording(4, 3.0)};
  FilterOptions const filter = clean_filter();
  Section const section{};
};

// energy that columns explain beside others
double explained(Eigen::MatrixXd const& columns, Eigen::MatrixXd const& beside, Eigen::VectorXd const& signal) {
  Eigen::MatrixXd both(beside.rows(), beside.cols() + columns.cols());
  both << beside, columns;
  auto const left = [&](Eigen::MatrixXd const& of) { return test::left_beside(of, signal).squaredNorm(); };
  return left(beside) - left(both);
}

TEST_F(ColumnExportTest, GainIsWhatLeastSquaresFindsInTheColumns) {
  ColumnExport const result = exported(1);
  auto const& record = result.train;
  for (std::size_t i = 0; i < result.candidates.size(); ++i) {
    auto const& candidate = result.candidates[i];
    ASSERT_EQ(record.candidates[i].rows(), record.torque.size());
    ASSERT_EQ(record.candidates[i].cols(), static_cast<Eigen::Index>(candidate.effect->n_linear()));
    double const gain = explained(record.candidates[i], record.regressor, record.torque);
    EXPECT_NEAR(candidate.gain, gain, 1e-6 * gain) << candidate.effect->name();
  }
}

TEST_F(ColumnExportTest, TheEffectThatIsThereExplainsMostAndNearlyAllOfTheResidual) {
  ColumnExport const result = exported(2);
  auto const best = std::max_element(result.candidates.begin(), result.candidates.end(),
                                     [](auto const& a, auto const& b) { return a.gain < b.gain; });
  ASSERT_NE(best, result.candidates.end());
  EXPECT_EQ(best->effect->name(), "stribeck");
  EXPECT_GT(best->grid_points, 1u);
  double const residual = test::left_beside(result.train.regressor, result.train.torque).squaredNorm();
  EXPECT_GT(best->gain, 0.9 * residual);
}

TEST_F(ColumnExportTest, EveryCandidateIsListedOnce) {
  ColumnExport const result = exported(1);
  EXPECT_EQ(result.candidates.size() + result.not_testable.size(), 4u);
}

TEST_F(ColumnExportTest, TheValidationRecordingHasTheSameColumns) {
  ColumnExport const result = exported(1);
  ASSERT_EQ(result.validate.size(), 1u);
  auto const& validation = result.validate.front();
  ASSERT_EQ(validation.candidates.size(), result.candidates.size());
  EXPECT_LT(validation.torque.size(), result.train.torque.size());
  // what was fitted in training holds there
  for (std::size_t i = 0; i < result.candidates.size(); ++i) {
    if (result.candidates[i].effect->name() != "stribeck") continue;
    auto const& train_record = result.train;
    Eigen::MatrixXd fitted(train_record.torque.size(), train_record.regressor.cols() + 1);
    fitted << train_record.regressor, train_record.candidates[i];
    Eigen::VectorXd const parameters = test::least_squares(fitted, train_record.torque);
    Eigen::VectorXd const baseline = test::least_squares(train_record.regressor, train_record.torque);
    Eigen::MatrixXd seen(validation.torque.size(), fitted.cols());
    seen << validation.regressor, validation.candidates[i];
    EXPECT_LT((validation.torque - seen * parameters).norm(),
              0.5 * (validation.torque - validation.regressor * baseline).norm());
  }
}

TEST_F(ColumnExportTest, HasTheSameBitsForAnyNumberOfThreads) {
  ColumnExport const alone = exported(1), together = exported(3);
  ASSERT_EQ(alone.candidates.size(), together.candidates.size());
  for (std::size_t i = 0; i < alone.candidates.size(); ++i) {
    EXPECT_EQ(alone.candidates[i].shape, together.candidates[i].shape);
    EXPECT_EQ(alone.candidates[i].gain, together.candidates[i].gain);
    EXPECT_EQ(alone.train.candidates[i], together.train.candidates[i]);
  }
}

}  // namespace column_export_test
