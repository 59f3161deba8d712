#include "engine/fit/problem/objective_options.hpp"

#include <gtest/gtest.h>

#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace objective_options_test {

TEST(Losses, AreTheWordsOfTheLossOption) {
  for (auto const& choice : loss_choices()) {
    ObjectiveOptions options;
    std::vector<Problem> problems;
    ObjectiveOptions::table().apply({"estimator", {}, {{"loss", choice.name}}}, options, problems);
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(options.loss, choice.name);
    EXPECT_EQ(make_loss(options, test::seed_data(5.0, 0.3)).kind, choice.kind);
  }
  EXPECT_EQ(find_loss("cauchy"), nullptr);
}

TEST(AutomaticHuberDelta, MakesTheSearchMinimiseWhatIrlsMinimises) {
  auto data = test::seed_data(20.0, 0.05);
  for (Eigen::Index t = 0; t < data.rows(); t += 10) data.tau[t] += 1.5;
  auto const irls = test::fit("irls", data);
  auto const loss = make_loss({"huber", 0.0, "mse"}, data);
  EXPECT_NEAR(loss.delta, 1.345 * irls.scale, 1e-12);

  // every small step away from irls costs
  ResidualObjective const objective(data, {{-1, -1, -1, -1}, {1, 1, 1, 1}}, loss);
  std::vector<double> rows(irls.parameters.begin(), irls.parameters.end());
  for (int r = 0; r < 4; ++r)
    for (double const step : {-1e-3, 1e-3}) {
      rows.insert(rows.end(), irls.parameters.begin(), irls.parameters.end());
      rows[rows.size() - 4 + static_cast<std::size_t>(r)] += step;
    }
  Workspace workspace;
  std::vector<double> fitness(9);
  objective.evaluate({rows.data(), 9, 4}, fitness, workspace);
  for (std::size_t m = 1; m < 9; ++m) EXPECT_GT(fitness[m], fitness[0]) << m;
}

TEST(HuberDelta, IsTakenAsWritten) {
  EXPECT_EQ(make_loss({"huber", 0.25, "mse"}, test::seed_data(5.0, 0.3)).delta, 0.25);
}

TEST(FitnessScale, IsMseUnlessWritten) {
  EXPECT_EQ(fitness_scale({}), FitnessScale::mse);
  EXPECT_EQ(fitness_scale({"squares", 0.0, "sse"}), FitnessScale::sse);
}

}  // namespace objective_options_test
}  // namespace torquescope
