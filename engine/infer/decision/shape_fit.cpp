#include "engine/infer/decision/shape_fit.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

struct MovingShape {
  std::size_t effect = 0, place = 0;
  double lower = 0.0, upper = 0.0;
};

// in the order of their tangents
std::vector<MovingShape> moving_shapes(JointModel const& model) {
  std::vector<MovingShape> moving;
  for (std::size_t i = 0; i < model.effects().size(); ++i) {
    auto const ranges = model.effects()[i].effect->shape_bounds(model.reference().scales);
    for (std::size_t k = 0; k < ranges.size(); ++k)
      if (ranges[k].upper > ranges[k].lower) moving.push_back({i, k, ranges[k].lower, ranges[k].upper});
  }
  return moving;
}

double value_of(JointModel const& model, MovingShape const& one) {
  return model.effects()[one.effect].shape[one.place];
}

// by how much each shape would change, were the model a plane
VectorXd full_step(FittedModel const& by, std::vector<MovingShape> const& moving) {
  constexpr double free = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd const& base = by.fitted->base();
  Index const first = base.cols() - std::ssize(moving);
  CoefficientBounds bounds{VectorXd::Constant(base.cols(), -free), VectorXd::Constant(base.cols(), free)};
  for (std::size_t k = 0; k < moving.size(); ++k) {
    double const value = value_of(*by.model, moving[k]);
    bounds.lower[first + static_cast<Index>(k)] = std::min(0.0, moving[k].lower - value);
    bounds.upper[first + static_cast<Index>(k)] = std::max(0.0, moving[k].upper - value);
  }
  return solve_scaled(base, by.fitted->residual(), bounds).col(0).tail(std::ssize(moving));
}

std::vector<ShapedEffect> moved(JointModel const& model, std::vector<MovingShape> const& moving, VectorXd const& by) {
  std::vector<ShapedEffect> effects = model.effects();
  for (std::size_t k = 0; k < moving.size(); ++k) {
    double& value = effects[moving[k].effect].shape[moving[k].place];
    value = std::clamp(value + by[static_cast<Index>(k)], moving[k].lower, moving[k].upper);
  }
  return effects;
}

bool are_plausible(std::vector<ShapedEffect> const& effects, JointScales const& scales) {
  return std::all_of(effects.begin(), effects.end(),
                     [&](ShapedEffect const& one) { return one.effect->is_plausible(one.shape, scales); });
}

double squares(FittedModel const& by) { return by.fitted->chosen().fit.energy(); }

// along the step, as long as it has to be for squares to fall
std::optional<FittedModel> better(FittedModel const& than, std::vector<MovingShape> const& moving,
                                  FittedWith const& fitted_with) {
  constexpr int halvings = 4;
  constexpr double least_fall = 1e-3;  // relative: where a search has come to rest
  VectorXd step = full_step(than, moving);
  for (int k = 0; k < halvings; ++k, step *= 0.5) {
    auto effects = moved(*than.model, moving, step);
    if (!are_plausible(effects, than.model->reference().scales)) continue;
    FittedModel trial = fitted_with(std::move(effects));
    if (squares(trial) < (1.0 - least_fall) * squares(than)) return trial;
  }
  return std::nullopt;
}

}  // namespace

FittedModel with_fitted_shapes(FittedModel from, FittedWith const& fitted_with) {
  constexpr int most_steps = 8;
  auto const moving = moving_shapes(*from.model);
  if (moving.empty()) return from;
  for (int k = 0; k < most_steps; ++k) {
    auto next = better(from, moving, fitted_with);
    if (!next) break;
    from = std::move(*next);
  }
  return from;
}

}  // namespace torquescope
