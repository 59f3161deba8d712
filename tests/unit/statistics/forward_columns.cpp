// A choice of columns: against an exhaustive search where that is the same, and on rows that it was not made on.

#include "engine/fit/statistics/forward_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random_stream.hpp"
#include "engine/fit/statistics/blocked_cv.hpp"
#include "support/decompositions.hpp"

namespace torquescope {
namespace forward_columns_test {

constexpr Eigen::Index n = 600, guard = 10;
constexpr double own = 0.14;

struct Drawn {
  Eigen::VectorXd noise = Eigen::VectorXd(n);
  Eigen::MatrixXd model = Eigen::MatrixXd(n, 3), library = Eigen::MatrixXd(n, 9);
};

Drawn drawn(std::uint32_t set) {
  RandomStream stream({43, set, RandomDomain::test}, 0, 0);
  Drawn made;
  for (double& value : made.noise) value = stream.normal();
  for (Eigen::MatrixXd* part : {&made.model, &made.library})
    for (double& value : part->reshaped()) value = stream.normal();
  return made;
}

double left_by(Eigen::VectorXd const& y, Eigen::MatrixXd const& x) { return test::left_beside(x, y).squaredNorm(); }

TEST(ForwardColumns, TakesTheColumnThatLeavesLeast) {
  for (std::uint32_t set = 0; set < 20; ++set) {
    auto const [noise, model, library] = drawn(set);
    Eigen::Index best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < library.cols(); ++k) {
      Eigen::MatrixXd both(n, model.cols() + 1);
      both << model, library.col(k);
      if (double const left = left_by(noise, both); left < least) least = left, best = k;
    }
    EXPECT_EQ(forward_columns(noise, model, library, 1, own), std::vector<Eigen::Index>{best}) << set;
  }
}

TEST(ForwardColumns, FindsTheTwoThatAreThere) {
  auto [noise, model, library] = drawn(30);
  Eigen::VectorXd const signal = 0.3 * noise + model.col(0) + 2.0 * library.col(7) - library.col(2);
  EXPECT_EQ(forward_columns(signal, model, library, 2, own), (std::vector<Eigen::Index>{7, 2}));
}

TEST(ForwardColumns, KnowsNothingOfAColumnThatIsOneNumberWithTheModel) {
  auto [noise, model, library] = drawn(31);
  library.col(4) = model.col(1) + 0.05 * library.col(4);
  Eigen::VectorXd const signal = 0.1 * noise + library.col(4) - model.col(1);
  for (Eigen::Index const k : forward_columns(signal, model, library, 9, own)) EXPECT_NE(k, 4);
  EXPECT_EQ(forward_columns(signal, model, library, 9, own).size(), 8U);
}

// the choice must not see the rows that it is judged on: of pure noise nothing is predicted
TEST(ForwardResiduals, PredictNothingOfNoise) {
  for (std::uint32_t set = 40; set < 60; ++set) {
    auto const [noise, model, library] = drawn(set);
    Eigen::VectorXd const left = forward_residuals(noise, model, library, 2, own, guard);
    EXPECT_GT(left.norm(), 0.995 * blocked_residuals(noise, model, guard).norm()) << set;
  }
}

TEST(ForwardResiduals, LeaveTheNoiseOfWhatIsThere) {
  auto [noise, model, library] = drawn(61);
  Eigen::VectorXd const signal = 0.1 * noise + model.col(2) + library.col(3) + library.col(5);
  EXPECT_NEAR(forward_residuals(signal, model, library, 2, own, guard).norm() / noise.norm(), 0.1, 0.005);
}

}  // namespace forward_columns_test
}  // namespace torquescope
