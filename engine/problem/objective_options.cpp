#include "engine/problem/objective_options.hpp"

#include <fmt/format.h>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"
#include "engine/problem/estimator.hpp"

namespace torquescope {
namespace {

std::vector<std::string> loss_names() {
  std::vector<std::string> names;
  for (auto const& choice : loss_choices()) names.push_back(choice.name);
  return names;
}

LeastSquaresFit robust_fit(RegressionData const& data) {
  std::vector<Problem> problems;
  return find_estimator("irls")->prepare({}, {}, problems)(data);
}

Problem problem_at(Section const& model, std::string const& key, std::string what) {
  Problem problem{ExitCode::bad_job, std::move(what)};
  problem.place = model.where(key);
  problem.key = "model." + key;
  return problem;
}

std::vector<double> spread(std::vector<double> const& given, Regressor const& regressor, Section const& model,
                           std::string const& key, std::vector<Problem>& problems) {
  if (given.size() == 1) return std::vector<double>(regressor.size(), given[0]);
  if (given.size() != regressor.size()) {
    problems.push_back(problem_at(
        model, key,
        fmt::format("model.{} has {} numbers, the model has {} parameters", key, given.size(), regressor.size())));
    problems.back().notes = {"the parameters are: " + fmt::format("{}", fmt::join(regressor.names(), ", "))};
    problems.back().help = "write one number for each parameter, or one for all";
  }
  return given;
}

}  // namespace

OptionTable<ObjectiveOptions> const& ObjectiveOptions::table() {
  static OptionTable<ObjectiveOptions> const table(
      "estimator", "what a population method minimises",
      {{"loss", &ObjectiveOptions::loss, loss_names(), "how a residual counts (torquescope list losses)"},
       {"huber_delta", &ObjectiveOptions::huber_delta, "N m or N", 0.0, 1e12,
        "residuals beyond it pull with constant force; 0: 1.345 times their robust scale, as irls"},
       {"fitness_scale", &ObjectiveOptions::fitness_scale, std::vector<std::string>{"mse", "sse"},
        "mean or sum over the samples (the seed's eq. 10 is the sum; it changes what FADE does)"}});
  return table;
}

Loss make_loss(ObjectiveOptions const& options, RegressionData const& data) {
  auto const* choice = find_loss(options.loss);
  TORQUESCOPE_EXPECT(choice != nullptr);
  if (choice->kind == LossKind::squares) return {};
  return {choice->kind, options.huber_delta > 0.0 ? options.huber_delta : 1.345 * robust_fit(data).scale};
}

FitnessScale fitness_scale(ObjectiveOptions const& options) {
  return options.fitness_scale == "sse" ? FitnessScale::sse : FitnessScale::mse;
}

Bounds parameter_box(ModelOptions const& options, Regressor const& regressor, Section const& model) {
  std::vector<Problem> problems;
  Bounds box{spread(options.lower, regressor, model, "lower", problems),
             spread(options.upper, regressor, model, "upper", problems)};
  if (!problems.empty()) throw Error(std::move(problems));
  for (std::size_t r = 0; r < box.dimension(); ++r) {
    if (box.lower[r] < box.upper[r]) continue;
    problems.push_back(problem_at(model, "lower",
                                  fmt::format("the box of {} is empty: lower = {:g} is not below upper = {:g}",
                                              regressor.names()[r], box.lower[r], box.upper[r])));
    problems.back().help = "exchange them, or widen the box";
  }
  if (!problems.empty()) throw Error(std::move(problems));
  return box;
}

}  // namespace torquescope
