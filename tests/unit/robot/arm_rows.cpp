// Rows with samples in lanes against the scalar regressor, on every instruction set.
#include "engine/robot/arm_rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/robot_registry.hpp"
#include "kernels/dispatch.hpp"
#include "unit/robot/arm_signals.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace arm_rows_test {

using Eigen::Index;

ArmRows rows_of(SerialChain const& chain, BaseParameters const& base) {
  return {chain, base, std::vector<FrictionColumns>(chain.joints.size())};
}

double sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

// the row of one sample, column by column as ArmRows lists them
Eigen::RowVectorXd scalar_row(SerialChain const& chain, BaseParameters const& base, DriveInertias drives,
                              std::vector<ArmColumn> const& columns, test::ArmSignals const& at, Index t, Index joint) {
  Eigen::MatrixXd const phi = base.pick(
      arm_regressor(chain, at.q.row(t).transpose(), at.dq.row(t).transpose(), at.ddq.row(t).transpose(), drives));
  Eigen::RowVectorXd row(static_cast<Index>(columns.size()) + 1);
  std::array<double, 3> const friction{at.dq(t, joint), sign(at.dq(t, joint)), 1.0};
  std::size_t of_the_joint = 0;
  for (std::size_t c = 0; c < columns.size(); ++c)
    row[static_cast<Index>(c)] =
        columns[c].base == ArmColumn::of_the_joint ? friction.at(of_the_joint++) : phi(joint, columns[c].base);
  row[row.size() - 1] = at.tau(t, joint);
  return at.root_weight(t, joint) * row;
}

void expect_scalar_rows(SerialChain const& chain, DriveInertias drives, std::string const& name) {
  BaseParameters const base(chain, drives);
  auto const rows = rows_of(chain, base);
  // two blocks and a ragged group
  test::ArmSignals const signals(kernels::row_block_samples + 19, chain.size(), 5);
  for (Index joint = 0; joint < chain.size(); ++joint) {
    auto const made = rows.rows(signals.samples(), joint);
    Eigen::MatrixXd expected(made.rows(), made.cols());
    ASSERT_EQ(made.rows(), signals.q.rows());
    ASSERT_EQ(made.cols(), static_cast<Index>(rows.columns(joint).size()) + 1);
    for (Index t = 0; t < made.rows(); ++t)
      expected.row(t) = scalar_row(chain, base, drives, rows.columns(joint), signals, t, joint);
    double const longest = expected.colwise().norm().maxCoeff();
    for (Index c = 0; c < made.cols(); ++c) {
      // the scalar one keeps what cos(pi / 2) = 6e-17 takes over from other columns, also in columns that are zero
      double const of_right_angles = 1e-15 * longest;
      EXPECT_LE((made.col(c) - expected.col(c)).cwiseAbs().maxCoeff(), 1e-12 * expected.col(c).norm() + of_right_angles)
          << name << ", joint " << joint + 1 << ", column " << c;
    }
  }
}

TEST(ArmRows, EqualTheScalarRegressorOfKnownArms) {
  for (auto const drives : {DriveInertias::left_out, DriveInertias::included}) {
    expect_scalar_rows(test::crs_a465(5), drives, "CRS, five joints");
    expect_scalar_rows(test::crs_a465(6), drives, "CRS");
    expect_scalar_rows(test::ur10e(), drives, "UR10e");
    expect_scalar_rows(test::panda(), drives, "Panda");
    expect_scalar_rows(test::puma_560(), drives, "PUMA");
  }
}

TEST(ArmRows, EqualTheScalarRegressorOfRobotFiles) {
  auto const folder = std::filesystem::path(TORQUESCOPE_SOURCE_DIR) / "jobs" / "robots";
  for (auto const* file : {"crs_a465.toml", "panda.toml", "puma560.toml", "tx40.toml", "ur10e.toml"})
    expect_scalar_rows(read_robot(folder / file), DriveInertias::included, file);
}

TEST(ArmRows, EqualTheScalarRegressorOfRandomArmsThatTurnAndSlide) {
  for (std::uint32_t number = 0; number < 120; ++number)
    expect_scalar_rows(test::random_arm(number, number % 2 == 0).chain, DriveInertias::included,
                       "arm " + std::to_string(number));
}

TEST(ArmRows, HaveTheSameBitsOnEveryInstructionSet) {
  for (std::uint32_t number = 0; number < 20; ++number) {
    auto const chain = number == 0 ? test::ur10e() : test::random_arm(number, number % 2 == 0).chain;
    BaseParameters const base(chain, DriveInertias::included);
    auto const rows = rows_of(chain, base);
    test::ArmSignals const signals(37, chain.size(), number);
    for (Index joint = 0; joint < chain.size(); ++joint) {
      auto const best = rows.rows(signals.samples(), joint);
      for (auto const name : kernels::supported_instruction_sets()) {
        ASSERT_TRUE(kernels::force_instruction_set(name));
        EXPECT_EQ(rows.rows(signals.samples(), joint), best) << name << ", arm " << number;
      }
      kernels::release_instruction_set();
    }
  }
}

TEST(ArmRows, OfAllJointsAreThoseOfEachWithoutTheTorque) {
  auto const chain = test::crs_a465(4);
  BaseParameters const base(chain, DriveInertias::included);
  auto const rows = rows_of(chain, base);
  test::ArmSignals const signals(kernels::row_block_samples + 21, chain.size(), 7);
  std::vector<Eigen::MatrixXd> all;
  for (Index j = 0; j < chain.size(); ++j)
    all.push_back(Eigen::MatrixXd::Constant(signals.q.rows(), static_cast<Index>(rows.columns(j).size()) + 2, 9.0));
  rows.fill(signals.samples(), all);
  for (Index j = 0; j < chain.size(); ++j) {
    auto const count = static_cast<Index>(rows.columns(j).size());
    auto const& made = all[static_cast<std::size_t>(j)];
    EXPECT_EQ(made.leftCols(count), rows.rows(signals.samples(), j).leftCols(count)) << j;
    EXPECT_EQ(made.rightCols(2), Eigen::MatrixXd::Constant(made.rows(), 2, 9.0)) << j;  // not its own
  }
}

TEST(ArmRows, OfASampleDoNotDependOnItsPlace) {
  auto const chain = test::panda();
  BaseParameters const base(chain, DriveInertias::included);
  auto const rows = rows_of(chain, base);
  test::ArmSignals const signals(300, chain.size(), 1);
  for (Index joint = 0; joint < chain.size(); ++joint) {
    auto const all = rows.rows(signals.samples(), joint);
    for (Index const first : {1, 6, 131})
      EXPECT_EQ(rows.rows(signals.samples(first, 150), joint), all.middleRows(first, 150)) << first;
  }
}

TEST(ArmRows, NameTheirColumns) {
  auto const chain = test::crs_a465(5);
  BaseParameters const base(chain, DriveInertias::included);
  std::vector<FrictionColumns> friction(5);
  friction[4] = {.viscous = true, .coulomb = false, .offset = true};
  ArmRows const rows(chain, base, friction);
  std::vector<std::string> last;
  for (auto const& column : rows.columns(4)) last.push_back(column.name);
  ASSERT_EQ(last.size(), 10U);
  EXPECT_EQ(std::vector<std::string>(last.end() - 3, last.end()),
            (std::vector<std::string>{"drive_5", "viscous_5", "offset_5"}));
  // every base parameter of the links acts on the first joint
  EXPECT_EQ(rows.columns(0).size(), 29U + 3U);
}

}  // namespace arm_rows_test
}  // namespace torquescope
