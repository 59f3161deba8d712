#pragma once
// The [model] section of a job: which terms one joint has.

#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/effects/regressor.hpp"

namespace torquescope {

struct ModelOptions {
  std::string joint = "revolute";
  std::vector<std::string> terms{};
  double velocity_deadband = 0.0;

  static OptionTable<ModelOptions> const& table();
};

// Errors     as Regressor()
Regressor make_regressor(ModelOptions const& options, Section const& model);

}  // namespace torquescope
