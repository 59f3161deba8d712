// A catalogue is scanned on fewer samples than are recorded: its columns are those of every sample, nearly.

#include "engine/infer/search/scan_motion.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "engine/effects/effect.hpp"
#include "engine/infer/search/candidate_columns.hpp"
#include "engine/infer/search/model_stage.hpp"
#include "engine/infer/search/shape_grid.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;

namespace scan_motion_test {

FilterOptions filter_with(double cutoff_hz, double parallel_cutoff_hz, double decimate_to_hz) {
  FilterOptions filter;
  filter.cutoff_hz = cutoff_hz;
  filter.parallel_cutoff_hz = parallel_cutoff_hz;
  filter.decimate_to_hz = decimate_to_hz;
  return filter;
}

Eigen::Index step_of(FilterOptions const& filter, double rate_hz, Eigen::Index samples = 20'000) {
  RecordPipeline const pipeline(test::clean_regressor(), filter, rate_hz, samples);
  return scan_step(pipeline, pipeline.motion_band_hz());
}

TEST(ScanStep, LeavesTheBandOfMotionAndRows) {
  EXPECT_EQ(step_of(filter_with(60, 30, 100), 1000), 5) << "200 Hz, beyond 2.56 x 60 and 6 x 30";
  EXPECT_EQ(step_of(filter_with(90, 30, 100), 1000), 2) << "2.56 x 90 Hz";
  EXPECT_EQ(step_of(filter_with(60, 40, 100), 1000), 2) << "6 x 40 Hz";
  EXPECT_EQ(step_of(filter_with(60, 30, 100), 100), 1);
  EXPECT_EQ(step_of(filter_with(60, 30, 1000), 1000), 1) << "every sample is a row";
}

TEST(ScanStep, TakesEverySampleWhereTheMotionMayHaveAnyFrequency) {
  EXPECT_EQ(step_of(filter_with(0, 30, 100), 1000), 1);
  EXPECT_EQ(step_of(filter_with(60, 30, 100), 1000, 300), 2) << "a hundred samples at least";
}

TEST(ScanMotion, MakesTheColumnsOfEveryLawNearlyAsTheyAre) {
  Recording const recording = test::recorded(simulate_joint(test::clean_joint().plan, 4));
  FilterOptions const filter = filter_with(60, 30, 100);
  Section const section{};
  StageSetting const setting{recording, test::clean_regressor(), filter, section, 16, 1, 2};
  ModelStage const stage = make_stage(setting, test::clean_regressor()).value();
  CandidateColumns const columns(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters());
  std::size_t looked_at = 0;
  for (auto const* effect : effect_choices()) {
    if (!effect->exists_on(columns.joint()) || effect->is_given()) continue;
    ShapeGrid const grid = shape_grid(*effect, columns.scales());
    std::vector<std::vector<double>> const shapes{grid.point(0), grid.point(grid.size() / 2)};
    auto const full = columns.group_of_each(*effect, shapes),
               scan = columns.group_of_each(*effect, shapes, LawRate::scan);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (full[i].rank() == 0) continue;
      ASSERT_EQ(scan[i].rank(), full[i].rank()) << effect->name();
      // of an energy that the law explains, the share that the other columns explain
      double const common = (full[i].q.transpose() * scan[i].q).squaredNorm() / static_cast<double>(full[i].rank());
      EXPECT_GT(common, 0.9) << effect->name();
      looked_at += needs_every_sample(*effect) ? 0 : 1;
    }
  }
  EXPECT_GE(looked_at, 25U);
}

}  // namespace scan_motion_test
