#include "engine/fit/excite/excitation_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/fit/optim/optimiser.hpp"
#include "unit/excite/arm_rows.hpp"

namespace torquescope {
namespace excitation_search_test {

ExciteOptions quick() {
  ExciteOptions options;
  options.evaluations = 600;
  return options;
}

std::vector<double> numbers_of(FourierMotion const& motion) {
  std::vector<double> numbers;
  for (auto const& joint : motion.joints) {
    numbers.push_back(joint.centre);
    numbers.insert(numbers.end(), joint.cosine.begin(), joint.cosine.end());
    numbers.insert(numbers.end(), joint.sine.begin(), joint.sine.end());
  }
  return numbers;
}

TEST(ExcitationSearch, EveryOptimiserFindsABetterMotion) {
  auto const chain = test::limited_crs(3);
  auto const model = test::row_model(chain);
  for (auto const& choice : optimiser_choices()) {
    ExciteOptions options = quick();
    options.optimiser = choice.name;
    auto const found = search_excitation(chain, model, options, 1, 1);
    EXPECT_GT(found.best.log_determinant, found.usual.log_determinant + 0.2) << choice.name;
    EXPECT_EQ(found.evaluations, options.evaluations) << choice.name;
  }
}

TEST(ExcitationSearch, ConditionFallsWhereItIsTheCriterion) {
  auto const chain = test::limited_crs(3);
  auto const model = test::row_model(chain);
  ExciteOptions options = quick();
  options.criterion = "condition";
  auto const found = search_excitation(chain, model, options, 1, 1);
  EXPECT_LT(found.best.condition, 0.7 * found.usual.condition);
}

TEST(ExcitationSearch, SameMotionOnAnyNumberOfThreads) {
  auto const chain = test::limited_crs(3);
  auto const model = test::row_model(chain);
  auto const one = numbers_of(search_excitation(chain, model, quick(), 7, 1).motion);
  EXPECT_EQ(one, numbers_of(search_excitation(chain, model, quick(), 7, 3).motion));
  EXPECT_NE(one, numbers_of(search_excitation(chain, model, quick(), 8, 1).motion));
}

TEST(ExcitationSearch, StaysAboveTheTableAndClearOfItself) {
  auto const chain = test::limited_crs(4);
  auto const model = test::row_model(chain);
  ExciteOptions options = quick();
  options.floor_m = 0.1;
  options.clearance_m = 0.1;
  auto const found = search_excitation(chain, model, options, 1, 2);
  auto const at = samples_of(found.motion, FourierTable(64 * 5, 5));
  for (Eigen::Index i = 0; i < at.q.rows(); ++i)
    EXPECT_EQ(clearance_lack(chain, {0.1, 0.1}, at.q.row(i).transpose()), 0.0) << i;
}

TEST(ExcitationSearch, ATableAboveTheArmIsTold) {
  auto const chain = test::limited_crs(3);
  ExciteOptions options = quick();
  options.floor_m = 5.0;
  EXPECT_THROW(search_excitation(chain, test::row_model(chain), options, 1, 1), Error);
}

TEST(ExcitationSearch, ParametersThatNothingMovesAreTold) {
  auto const chain = test::limited_crs(2);
  auto model = test::row_model(chain);
  ++model.size;
  EXPECT_THROW(search_excitation(chain, model, quick(), 1, 1), Error);
}

TEST(TorqueNoise, IsAShareOfTheLargestTorque) {
  auto chain = test::limited_crs(2);
  EXPECT_EQ(torque_noise(chain, {}), Eigen::Vector2d(1.0, 1.0));
  chain.joints[0].max_torque = 300.0;
  EXPECT_EQ(torque_noise(chain, {}), Eigen::Vector2d(1.0, 1.0));
  chain.joints[1].max_torque = 100.0;
  EXPECT_EQ(torque_noise(chain, {}), Eigen::Vector2d(3.0, 1.0));
  ExciteOptions options;
  options.torque_noise = {0.5, 0.25};
  EXPECT_EQ(torque_noise(chain, options), Eigen::Vector2d(0.5, 0.25));
}

}  // namespace excitation_search_test
}  // namespace torquescope
