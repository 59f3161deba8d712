#include "engine/infer/pipeline/joint_bounds.hpp"

#include <algorithm>
#include <array>

namespace torquescope {

JointBounds joint_bounds(JointModel const& model) {
  JointBounds bounds;
  bounds.non_negative = model.non_negative();
  constexpr std::array unit = {1.0};
  Eigen::Index column = 0;
  for (auto const* term : model.regressor().terms()) {
    auto const of = [&](JointState const& state) { return term->torque(state, unit, {}); };
    auto const size = static_cast<Eigen::Index>(term->n_linear());
    if (size == 1 && term->is_dry_friction()) {
      bool const acts_forward = of({.dq = 1.0}) != 0.0, acts_backward = of({.dq = -1.0}) != 0.0;
      if (acts_forward && acts_backward) bounds.friction = column;
      if (acts_forward && !acts_backward) bounds.forward = column;
      if (acts_backward && !acts_forward) bounds.backward = column;
    } else if (size == 1 && of({.ddq = 1.0}) != of({})) {
      bounds.inertia = column;
    }
    column += size;
  }
  return bounds;
}

Eigen::VectorXd without_negatives(Eigen::VectorXd fit, JointModel const& model) {
  std::vector<bool> const non_negative = model.non_negative();
  for (Eigen::Index k = 0; k < fit.size(); ++k)
    if (non_negative[static_cast<std::size_t>(k)]) fit[k] = std::max(0.0, fit[k]);
  return fit;
}

}  // namespace torquescope
