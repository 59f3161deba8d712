#pragma once
// What a search minimises: options of an [[estimator]].

#include <optional>
#include <string>

#include "engine/base/options.hpp"
#include "engine/fit/problem/residual_objective.hpp"

namespace torquescope {

struct ObjectiveOptions {
  std::string loss = "squares";
  double huber_delta = 0.0;
  std::string fitness_scale = "mse";
  std::string fitness = "auto";
  std::string precision = "float64";

  static OptionTable<ObjectiveOptions> const& table();
};

// float32 with a loss or fitness that it has no kernel for
std::optional<Problem> contradiction(ObjectiveOptions const& options, Section const& section);

// huber_delta = 0 becomes 1.345 times the scale of the converged IRLS residuals: the loss that irls minimises
// Errors     Error 65 as irls
Loss make_loss(ObjectiveOptions const& options, RegressionData const& data);
FitnessScale fitness_scale(ObjectiveOptions const& options);

}  // namespace torquescope
