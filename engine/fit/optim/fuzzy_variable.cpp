#include "engine/fit/optim/fuzzy_variable.hpp"

#include "engine/base/portable_math.hpp"

namespace torquescope {

double membership(FuzzyVariable const& variable, FuzzySet set, double x) {
  double const z = (x - variable.means[static_cast<std::size_t>(set)]) / variable.sigma;
  return portable_exp(-0.5 * (z * z));
}

SetLevels memberships(FuzzyVariable const& variable, double x) {
  SetLevels levels{};
  for (FuzzySet const set : fuzzy_sets) levels[static_cast<std::size_t>(set)] = membership(variable, set, x);
  return levels;
}

}  // namespace torquescope
