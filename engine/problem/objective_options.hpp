#pragma once
// What a search minimises and where it may look: options of an [[estimator]] and the box of the [model].

#include <string>

#include "engine/base/options.hpp"
#include "engine/effects/model_options.hpp"
#include "engine/optim/objective.hpp"
#include "engine/problem/residual_objective.hpp"

namespace torquescope {

struct ObjectiveOptions {
  std::string loss = "squares";
  double huber_delta = 0.0;
  std::string fitness_scale = "mse";

  static OptionTable<ObjectiveOptions> const& table();
};

// huber_delta = 0 becomes 1.345 times the scale of the converged IRLS residuals: the loss that irls minimises
// Errors     Error 65 as irls
Loss make_loss(ObjectiveOptions const& options, RegressionData const& data);
FitnessScale fitness_scale(ObjectiveOptions const& options);

// model.lower and model.upper, spread over the parameters when they are one number for all
// Errors     Error 78: as many numbers as neither one nor parameters, lower not below upper
Bounds parameter_box(ModelOptions const& options, Regressor const& regressor, Section const& model);

}  // namespace torquescope
