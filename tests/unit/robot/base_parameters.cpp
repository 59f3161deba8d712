#include "engine/robot/base_parameters.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "engine/base/random_stream.hpp"
#include "engine/robot/gather_text.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "support/decompositions.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace base_parameters_test {

Eigen::Index rank(SerialChain const& chain, DriveInertias drives) { return BaseParameters(chain, drives).size(); }

TEST(BaseParameters, RanksOfKnownArms) {
  std::array<Eigen::Index, 6> const rigid{1, 8, 15, 22, 29, 36}, with_drives{1, 8, 16, 24, 32, 40};
  for (std::size_t n = 1; n <= 6; ++n) {
    EXPECT_EQ(rank(test::crs_a465(n), DriveInertias::left_out), rigid[n - 1]) << n;
    EXPECT_EQ(rank(test::crs_a465(n), DriveInertias::included), with_drives[n - 1]) << n;
  }
  EXPECT_EQ(rank(test::ur10e(), DriveInertias::left_out), 36);
  EXPECT_EQ(rank(test::ur10e(), DriveInertias::included), 40);
  EXPECT_EQ(rank(test::panda(), DriveInertias::left_out), 43);
  EXPECT_EQ(rank(test::panda(), DriveInertias::included), 48);
  EXPECT_EQ(rank(test::puma_560(), DriveInertias::left_out), 36);
  EXPECT_EQ(rank(test::puma_560(), DriveInertias::included), 40);
}

// columns of length 1 of motions of its own, and what rounding may add to a singular value of theirs
struct SampledColumns {
  Eigen::MatrixXd scaled;
  double rounding;
};

// Rounding: an entry is a sum over the frames between its row and its link, about ten operations each, of terms as
// large as those of the longest column; scaling a column to 1 scales its errors. A singular value moves by no more than
// the norm of all errors (Weyl 1912).
SampledColumns sampled(SerialChain const& chain, int n_samples) {
  std::mt19937 bits(7);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  Eigen::Index const n = chain.size();
  Eigen::MatrixXd rows(n * n_samples, 11 * n);
  for (int sample = 0; sample < n_samples; ++sample) {
    auto const draw = [&] {
      return Eigen::VectorXd::NullaryExpr(n, [&](Eigen::Index) { return uniform(bits); }).eval();
    };
    rows.middleRows(n * sample, n) = arm_regressor(chain, draw(), draw(), draw(), DriveInertias::included);
  }
  Eigen::VectorXd const lengths = rows.colwise().norm();
  double const longest = lengths.maxCoeff();
  double errors = 0.0;
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    bool const stands = lengths[k] > 1e-12 * longest;  // cos(pi / 2) is not quite 0: what it leaves is no column
    rows.col(k) *= stands ? 1.0 / lengths[k] : 0.0;
    if (stands) errors += longest / lengths[k] * (longest / lengths[k]);
  }
  double const operations = 10.0 * static_cast<double>(n);
  return {rows, operations * std::numeric_limits<double>::epsilon() * std::sqrt(errors)};
}

TEST(BaseParameters, AreAsManyAsTheRankOfFiveHundredRandomArms) {
  for (std::uint32_t number = 0; number < 500; ++number) {
    auto const chain = test::random_arm(number, number % 5 != 0).chain;
    auto const columns = sampled(chain, 24);
    auto const values = test::singular_values(columns.scaled);
    Eigen::Index const n = rank(chain, DriveInertias::included);
    ASSERT_GT(n, 0);
    // what is kept stands two decades above rounding, what is not is rounding
    EXPECT_GT(values[n - 1], 100.0 * columns.rounding) << number;
    if (n < values.size()) {
      EXPECT_LT(values[n], columns.rounding) << number;
    }
  }
}

// the first of two almost equal columns used to stand, and a third that is their sum then counted as independent
TEST(BaseParameters, OfArmsWithoutQuiteRightAnglesAreAsManyAsTheRank) {
  RandomStream random({21, 0, RandomDomain::test}, 0, 0);
  for (std::uint32_t number = 0; number < 200; ++number) {
    auto chain = test::random_arm(number, true).chain;
    for (auto& joint : chain.joints) joint.alpha += std::pow(10.0, random.uniform(-4.0, -3.0));
    auto const values = test::singular_values(sampled(chain, 24).scaled);
    auto const n = (values.array() > 1e-12 * values[0]).count();
    EXPECT_EQ(rank(chain, DriveInertias::included), n) << number;
  }
}

TEST(BaseParameters, OfFiveJointsWithThreeFrictionsAreTheFortySevenOfTheCrsA465) {
  auto const chain = test::crs_a465(5);
  EXPECT_EQ(rank(chain, DriveInertias::included) + 3 * chain.size(), 47);
}

TEST(BaseParameters, HaveTheNamesAndSumsOfTheRule) {
  // a pendulum of two parallel joints: 10 numbers a link, 5 sums
  SerialChain chain;
  chain.joints.resize(2);
  chain.joints[0].alpha = 1.5707963267948966;
  chain.joints[1].a = 0.4;
  BaseParameters const base(chain, DriveInertias::left_out);
  std::vector<std::string> names, sums;
  for (Eigen::Index k = 0; k < base.size(); ++k) {
    names.push_back(base.parameters()[static_cast<std::size_t>(k)].name);
    sums.push_back(gather_text(base, k));
  }
  EXPECT_EQ(names, (std::vector<std::string>{"mxr1", "my1", "zzr1", "mx2", "my2", "zz2"}));
  EXPECT_EQ(sums[0], "mx1 + 0.4 m2");
  EXPECT_EQ(sums[2], "zz1 + 0.16 m2");
  EXPECT_EQ(sums[5], "zz2");
  EXPECT_EQ(base.without_effect().size(), 13u);  // m1 and out-of-plane numbers of both links
}

TEST(BaseParameters, DoNotDependOnTheUnitOfLength) {
  auto const metres = test::panda();
  auto small = metres;
  for (auto& joint : small.joints) {
    joint.a *= 1e-3;
    joint.d *= 1e-3;
  }
  EXPECT_EQ(BaseParameters(small, DriveInertias::included).columns(),
            BaseParameters(metres, DriveInertias::included).columns());
}

TEST(BaseParameters, GiveTheTorqueOfTheStandardOnes) {
  for (std::uint32_t number = 0; number < 100; ++number) {
    auto const arm = test::random_arm(number, number % 2 == 0);
    BaseParameters const base(arm.chain, DriveInertias::included);
    auto const chi = standard_parameters(arm.chain, DriveInertias::included);
    auto const phi = arm_regressor(arm.chain, arm.q, arm.dq, arm.ddq, DriveInertias::included);
    Eigen::VectorXd const tau = phi * chi;
    auto const values = base.from_standard(chi);
    EXPECT_LT((tau - base.pick(phi) * values).norm(), 1e-12 * tau.norm()) << number;
    EXPECT_LT((tau - phi * base.to_standard(values)).norm(), 1e-12 * tau.norm()) << number;
    EXPECT_LT((base.from_standard(base.to_standard(values)) - values).norm(), 1e-15);
  }
}

}  // namespace base_parameters_test
}  // namespace torquescope
