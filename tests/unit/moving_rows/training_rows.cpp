// Several training recordings as one set of rows: against a fit to all of them by plain least squares.

#include "engine/infer/moving_rows/training_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/infer/moving_rows/evidence.hpp"
#include "engine/infer/moving_rows/pooled_fit.hpp"
#include "engine/infer/moving_rows/recordings_in_turn.hpp"
#include "support/decompositions.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace training_rows_test {

constexpr std::size_t twins = 40;

Recording clean(std::uint32_t index) {
  CleanJoint joint = clean_joint();
  joint.plan.simulation.duration_s = 6.0;
  return recorded(simulate_joint(joint.plan, index));
}

class TrainingRowsOf : public testing::Test {
 protected:
  TrainingRowsOf() : stage(*make_stage(setting, clean_regressor())), evidence(setting, stage, {further, {}}) {}

  Eigen::VectorXd spread(Eigen::MatrixXd const& of) const {
    return (of.colwise() - of.rowwise().mean()).rowwise().norm() / std::sqrt(static_cast<double>(of.cols() - 1));
  }

  Recording const first = clean(5);
  std::vector<Recording> const further{clean(6), clean(7)};
  FilterOptions const filter = clean_filter();
  Section const section{};
  StageSetting const setting{first, clean_regressor(), filter, section, twins, 1, 2};
  ModelStage const stage;
  Evidence const evidence;
};

TEST_F(TrainingRowsOf, HasAnOrthonormalBasisAndFoldsOfEachRecording) {
  TrainingRows const& rows = evidence.training();
  ASSERT_EQ(rows.recordings().size(), 3U);
  Eigen::MatrixXd const gram = rows.basis().transpose() * rows.basis();
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_EQ(rows.recordings().back().rows.to, rows.basis().rows());
  auto const folds = rows.folds(FoldKind::whole);
  ASSERT_EQ(folds.size(), 30U);
  Eigen::Index at = 0;
  for (auto const& fold : folds)
    for (auto const& block : fold.inside) {
      EXPECT_EQ(block.from, at);
      at = block.to;
    }
  EXPECT_EQ(at, rows.basis().rows());
}

// each recording's replicates and own residual are as large: the model lacks nothing
TEST_F(TrainingRowsOf, LeavesOfARecordingWhatReplicatesLeave) {
  Eigen::VectorXd const left = evidence.left_in_folds().colwise().sum().transpose();
  double const mean = left.tail(static_cast<Eigen::Index>(twins)).mean();
  EXPECT_NEAR(left[0] / mean, 1.0, 0.2);
}

// what another fit to all rows, made by hand, says
TEST_F(TrainingRowsOf, FitsAllRecordingsTogether) {
  auto const pooled = pooled_fit(stage, evidence.training());
  ASSERT_TRUE(pooled.has_value());
  std::vector<ProcessedRecord> records;
  for (auto const* recording : {&first, &further[0], &further[1]})
    records.push_back(pipeline_for(setting, *recording, clean_regressor()).prepare(*recording));
  Eigen::Index n = 0;
  for (auto const& one : records) n += one.torque.size();
  Eigen::MatrixXd columns(n, 4);
  Eigen::VectorXd torque(n);
  Eigen::Index at = 0;
  for (auto const& one : records) {
    columns.middleRows(at, one.torque.size()) = one.columns;
    torque.segment(at, one.torque.size()) = one.torque;
    at += one.torque.size();
  }
  Eigen::VectorXd const by_hand = least_squares(columns, torque);
  Eigen::VectorXd const deviations = spread(pooled->deviations);
  Eigen::VectorXd const truth = clean_joint().truth;
  // weights and the bias of processing apart they are one fit; the offset of each recording is its own there
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_NEAR(pooled->parameters[k], by_hand[k], 0.01 * std::abs(truth[k])) << k;
    EXPECT_NEAR(pooled->parameters[k], truth[k], 4.0 * deviations[k]) << k;
  }
}

TEST_F(TrainingRowsOf, IsMoreCertainThanTheFirstAlone) {
  auto const pooled = pooled_fit(stage, evidence.training());
  ASSERT_TRUE(pooled.has_value());
  Eigen::VectorXd const together = spread(pooled->deviations), alone = spread(stage.comparison.twin_fits.transpose());
  // three times the rows: 1 / sqrt(3) = 0.58
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_LT(together[k], 0.8 * alone[k]) << k;
    EXPECT_GT(together[k], 0.4 * alone[k]) << k;
  }
}

TEST_F(TrainingRowsOf, PredictsEachByTheOthers) {
  Selection selection;
  auto const plain = std::make_shared<ModelStage const>(*make_stage(setting, clean_regressor()));
  selection.baseline = selection.final = plain;
  RecordingsInTurn const in_turn = recordings_in_turn(setting, further, selection);
  ASSERT_EQ(in_turn.recordings.size(), 3U);
  double left = 0.0;
  for (auto const& one : in_turn.recordings) {
    EXPECT_EQ(one.before, one.after);  // one model
    left += one.after.squaredNorm();
  }
  // what is predicted is a little worse than what is fitted
  EXPECT_GT(left, in_turn.fitted_after);
  EXPECT_LT(left, 1.1 * in_turn.fitted_after);
}

TEST(TrainingRowsAlone, AreThoseOfTheStage) {
  Recording const first = clean(5);
  FilterOptions const filter = clean_filter();
  Section const section{};
  StageSetting const setting{first, clean_regressor(), filter, section, twins, 1, 2};
  auto const stage = make_stage(setting, clean_regressor());
  ASSERT_TRUE(stage.has_value());
  Evidence const evidence(setting, *stage, {});
  EXPECT_EQ(evidence.training().basis().rows(), stage->comparison.rows.size());
  EXPECT_FALSE(pooled_fit(*stage, evidence.training()).has_value());
}

}  // namespace training_rows_test
