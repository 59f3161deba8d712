#include "engine/fit/problem/estimator.hpp"

namespace torquescope {

namespace estimators {
#define TORQUESCOPE_CHOICE(name) EstimatorChoice name();
#include "estimator_choices.inc"
#undef TORQUESCOPE_CHOICE
}  // namespace estimators

std::vector<EstimatorChoice> const& estimator_choices() {
  static std::vector<EstimatorChoice> const choices{
#define TORQUESCOPE_CHOICE(name) estimators::name(),
#include "estimator_choices.inc"
#undef TORQUESCOPE_CHOICE
  };
  return choices;
}

EstimatorChoice const* find_estimator(std::string const& name) {
  for (auto const& choice : estimator_choices())
    if (choice.name == name) return &choice;
  return nullptr;
}

}  // namespace torquescope
