// The gains of a law's shapes: of many at once as of each alone, and of unseen rows what is left there with them.

#include "engine/infer/moving_rows/evidence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/infer/search/shape_grid.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace evidence_test {

Recording clean(std::uint32_t index) {
  CleanJoint joint = clean_joint();
  joint.plan.simulation.duration_s = 6.0;
  return recorded(simulate_joint(joint.plan, index));
}

class EvidenceOf : public testing::TestWithParam<char const*> {
 protected:
  EvidenceOf() : stage(*make_stage(setting, clean_regressor())), evidence(setting, stage, {{}, unseen}) {}

  // over all of the law's grid: shapes that the model explains as well
  std::vector<std::vector<double>> shapes_of(Effect const& effect) const {
    ShapeGrid const grid = shape_grid(effect, evidence.columns().scales());
    std::size_t const every = std::max<std::size_t>(1, grid.size() / 11);
    std::vector<std::vector<double>> shapes;
    for (std::size_t i = 0; i < grid.size(); i += every) shapes.push_back(grid.point(i));
    return shapes;
  }

  Recording const first = clean(5);
  std::vector<Recording> const unseen{clean(6), clean(7)};
  FilterOptions const filter = clean_filter();
  Section const section{};
  StageSetting const setting{first, clean_regressor(), filter, section, 40, 1, 2};
  ModelStage const stage;
  Evidence const evidence;
};

// on unseen rows to the last bit; in training several go through one solution
TEST_P(EvidenceOf, ManyShapesIsThatOfEachAlone) {
  Effect const& effect = *find_effect(GetParam());
  auto const shapes = shapes_of(effect);
  for (LawRate rate : {LawRate::full, LawRate::scan}) {
    auto const together = evidence.gains(effect, shapes, FoldKind::whole, DrivenBy::twin, rate);
    ASSERT_EQ(together.size(), shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      LawGain const alone = evidence.gains(effect, {shapes[i]}, FoldKind::whole, DrivenBy::twin, rate).front();
      ASSERT_EQ(together[i].is_testable, alone.is_testable) << i;
      EXPECT_TRUE(together[i].train.isApprox(alone.train, 1e-9)) << i;
      EXPECT_TRUE(together[i].first.isApprox(alone.first, 1e-9)) << i;
      EXPECT_EQ(together[i].unseen, alone.unseen) << i;
    }
  }
}

// the same energies by another way: row by row
TEST_P(EvidenceOf, AShapeOnUnseenRowsIsTheFallOfWhatIsLeftThere) {
  Effect const& effect = *find_effect(GetParam());
  auto const energy_unseen = [](RowsLeft const& left) {
    double energy = 0.0;
    for (std::size_t part = 1; part < left.parts.size(); ++part) energy += left.parts[part].left.squaredNorm();
    return energy;
  };
  RowsLeft const before = evidence.rows_left(FoldKind::whole);
  ASSERT_EQ(before.parts.size(), 3U);
  auto const shapes = shapes_of(effect);
  auto const gains = evidence.gains(effect, shapes, FoldKind::whole);
  int compared = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!gains[i].is_testable || gains[i].unseen[0] == 0.0) continue;  // none with signs that physics allows
    ++compared;
    double const fall = energy_unseen(before) - energy_unseen(evidence.rows_left(effect, shapes[i], FoldKind::whole));
    EXPECT_NEAR(gains[i].unseen[0], fall, 1e-9 * energy_unseen(before)) << i;
  }
  EXPECT_GT(compared, 0) << "nothing was compared";
}

INSTANTIATE_TEST_SUITE_P(OfLaws, EvidenceOf,
                         testing::Values("breakaway_dwell", "cable", "cogging", "friction_drift", "spring"),
                         [](auto const& of) { return std::string(of.param); });

}  // namespace evidence_test
