#include "engine/effects/passive_signs.hpp"

#include <array>

namespace torquescope {

Eigen::VectorXd passive_signs(Regressor const& regressor) {
  constexpr std::array unit = {1.0};
  Eigen::VectorXd signs = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(regressor.size()));
  Eigen::Index column = 0;
  for (auto const* term : regressor.terms()) {
    auto const of = [&](JointState const& state) { return term->torque(state, unit, {}); };
    auto const size = static_cast<Eigen::Index>(term->n_linear());
    if (size == 1 && of({}) == 0.0) {
      double const power = of({.dq = 1.0}) - of({.dq = -1.0}), mass = of({.ddq = 1.0});
      if (power != 0.0)
        signs[column] = power > 0.0 ? 1.0 : -1.0;
      else if (mass != 0.0)
        signs[column] = mass > 0.0 ? 1.0 : -1.0;
    }
    column += size;
  }
  return signs;
}

}  // namespace torquescope
