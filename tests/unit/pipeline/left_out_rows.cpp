// What a mask leaves out is counted in time and in energy, and the error over all rows is told beside it.

#include "engine/infer/pipeline/left_out_rows.hpp"

#include <gtest/gtest.h>

#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace left_out_rows_test {

TEST(LeftOutRows, CountsTimeAndEnergy) {
  Eigen::VectorXd const torque = Eigen::VectorXd::Constant(4, 2.0);
  auto const rows =
      left_out_rows(torque, Eigen::Vector4d(1.0, 3.0, 1.0, 1.0), Eigen::Vector4d(0.5, 3.0, 0.5, 0.5), {0, 2, 3});
  EXPECT_DOUBLE_EQ(rows.time_share(), 0.25);
  EXPECT_DOUBLE_EQ(rows.energy_share(), 0.75);
  EXPECT_DOUBLE_EQ(rows.torque, 16.0);
  EXPECT_DOUBLE_EQ(rows.after, 9.75);
  LeftOutRows sum = rows;
  sum += left_out_rows(torque, torque, torque, {0, 1, 2, 3});
  EXPECT_DOUBLE_EQ(sum.time_share(), 0.125);
  EXPECT_DOUBLE_EQ(sum.energy, 12.0 + 16.0);
}

TEST(LeftOutRows, OfAPipelineAreWhatItsMaskDrops) {
  Recording const recording = recorded(simulate_joint(clean_joint().plan, 3));
  RecordPipeline masked = clean_pipeline(recording), whole = clean_pipeline(recording);
  auto const kept = masked.prepare(recording).kept_rows;
  whole.restrict_to(whole.all_rows());
  ASSERT_EQ(whole.prepare(recording).torque.size(), masked.kept_samples());
  ASSERT_LT(kept.size(), whole.all_rows().size());
  std::vector<bool> samples(static_cast<std::size_t>(recording.position.size()), false);
  std::fill_n(samples.begin() + 2000, 1000, true);
  masked.leave_out(samples);
  EXPECT_LT(masked.prepare(recording).kept_rows.size(), kept.size());
}

}  // namespace left_out_rows_test
