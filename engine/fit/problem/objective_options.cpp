#include "engine/fit/problem/objective_options.hpp"

#include <fmt/format.h>

#include "engine/base/contract.hpp"
#include "engine/fit/problem/estimator.hpp"

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

}  // namespace

OptionTable<ObjectiveOptions> const& ObjectiveOptions::table() {
  static OptionTable<ObjectiveOptions> const table(
      "estimator", "what a population method minimises",
      {{"loss", &ObjectiveOptions::loss, loss_names(), "how a residual counts (torquescope list losses)"},
       {"huber_delta", &ObjectiveOptions::huber_delta, "N m or N", 0.0, 1e12,
        "residuals beyond it pull with constant force; 0: 1.345 times their robust scale, as irls"},
       {"fitness_scale", &ObjectiveOptions::fitness_scale, std::vector<std::string>{"mse", "sse"},
        "mean or sum over the samples (the seed's eq. 10 is the sum; it changes what FADE does)"},
       {"fitness", &ObjectiveOptions::fitness, std::vector<std::string>{"auto", "direct", "gram", "rollout"},
        "from every sample (direct), from sufficient statistics (gram: squares only, where it is exact to 1e-12), or "
        "from simulations of the recordings in their loops (rollout: position and torque, each by its noise)"},
       {"precision", &ObjectiveOptions::precision, std::vector<std::string>{"float64", "float32"},
        "float32: every sample at up to twice the speed, squares only; refused where noise is below 1e-3 of the "
        "torque"}});
  return table;
}

std::optional<Problem> contradiction(ObjectiveOptions const& options, Section const& section) {
  if (options.fitness == "rollout" && (options.loss != "squares" || options.precision != "float64"))
    return problem_at(section, "fitness", "fitness = \"rollout\" with a loss or a precision of its own",
                      "rollouts sum squares in float64: remove loss and precision");
  if (options.precision != "float32") return {};
  if (options.loss != "squares")
    return problem_at(section, "precision", fmt::format("precision = \"float32\" with loss = \"{}\"", options.loss),
                      "float32 sums squares only: remove precision, or write loss = \"squares\"");
  if (options.fitness == "gram")
    return problem_at(section, "precision", "precision = \"float32\" with fitness = \"gram\"",
                      "statistics are faster still and exact: remove precision, or fitness");
  return {};
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

}  // namespace torquescope
