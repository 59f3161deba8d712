// What [excite] separate names: columns of the model, or columns beside them.

#include "engine/experiment/separated_columns.hpp"

#include <gtest/gtest.h>

#include "engine/fit/excite/excitation_search.hpp"
#include "engine/robot/robot_registry.hpp"

namespace torquescope {
namespace separated_columns_test {

ArmModel crs() {
  return {read_robot(TORQUESCOPE_SOURCE_DIR "/jobs/robots/crs_a465.toml"), {{"viscous", "coulomb"}}, Section{}};
}

RowModel rows_of(ArmModel const& model) {
  RowModel rows;
  rows.size = static_cast<Eigen::Index>(model.size());
  for (std::size_t j = 0; j < model.joints(); ++j) rows.own.push_back(model.parameters_of(j));
  rows.noise = Eigen::VectorXd::Ones(5);
  rows.rows = [&model](MotionSamples const& samples) { return model.rows(joint_motions(samples)); };
  return rows;
}

ExciteOptions separating(std::string one, std::string other) {
  ExciteOptions options;
  options.separate = {std::move(one), std::move(other)};
  options.evaluations = 300;
  return options;
}

TEST(SeparatedColumns, OfTheModelAreItsParametersAndOthersComeBeside) {
  auto const model = crs();
  std::vector<Problem> problems;
  auto const rows = with_separated(rows_of(model), model, separating("stribeck@3", "viscous@3"), {}, problems);
  ASSERT_TRUE(problems.empty());
  auto const size = static_cast<Eigen::Index>(model.size());
  EXPECT_EQ(rows.size, size + 1);
  EXPECT_EQ(rows.one, std::vector<Eigen::Index>{size});
  ASSERT_EQ(rows.other.size(), 1u);
  EXPECT_EQ(model.names()[static_cast<std::size_t>(rows.other[0])], "viscous_3");
  EXPECT_EQ(rows.own[2].back(), size);

  auto const named = with_separated(rows_of(model), model, separating("mxr2", "viscous_2"), {}, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(named.size, size);
}

// beside a model that has Coulomb friction a Stribeck peak is told from viscous friction by slow strokes
TEST(SeparatedColumns, TheMotionFoundTellsThemBetter) {
  auto const model = crs();
  auto const options = separating("stribeck@3", "viscous@3");
  std::vector<Problem> problems;
  auto const rows = with_separated(rows_of(model), model, options, {}, problems);
  auto const found = search_excitation(model.chain(), rows, options, 1, 1);
  EXPECT_GT(found.usual.angle, 0.0);
  EXPECT_GT(found.best.angle, 1.05 * found.usual.angle);
}

TEST(SeparatedColumns, RefusesWhatIsNotThere) {
  auto const model = crs();
  for (auto const* wrong : {"stribek@3", "stribeck@6", "stribeck@", "viscous_9", "maxwell_slip@2", "viscous@3"}) {
    std::vector<Problem> problems;
    with_separated(rows_of(model), model, separating(wrong, "viscous@3"), {}, problems);
    EXPECT_EQ(problems.size(), 1u) << wrong;
  }
}

}  // namespace separated_columns_test
}  // namespace torquescope
