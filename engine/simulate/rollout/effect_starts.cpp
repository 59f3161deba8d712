#include "engine/simulate/rollout/effect_starts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "engine/base/dense_solvers.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

double middle_of(ParameterRange const& range) {
  return range.spacing == Spacing::logarithmic && range.lower > 0.0 ? std::sqrt(range.lower * range.upper)
                                                                    : 0.5 * (range.lower + range.upper);
}

// values of a shape, from its lower end to its upper one
std::vector<double> grid_of(EffectParameter const& parameter, ParameterRange const& range, JointScales const& scales) {
  constexpr double many = 40.0, most = 4000.0, half_wave = 0.5;
  double points = many;
  if (parameter.is_order())
    points = (range.upper - range.lower) * scales.position_range / (half_wave * 2.0 * std::numbers::pi);
  if (parameter.is_frequency()) points = (range.upper - range.lower) * scales.duration_s / half_wave;
  auto const n = static_cast<std::size_t>(std::clamp(std::ceil(points), many, most));
  bool const is_logarithmic = range.spacing == Spacing::logarithmic && range.lower > 0.0;
  bool const is_even = parameter.is_order() || parameter.is_frequency() || !is_logarithmic;
  std::vector<double> grid;
  for (std::size_t i = 0; i <= n; ++i) {
    double const share = static_cast<double>(i) / static_cast<double>(n);
    grid.push_back(is_even ? range.lower + share * (range.upper - range.lower)
                           : range.lower * std::pow(range.upper / range.lower, share));
  }
  return grid;
}

struct ShapeFit {
  std::vector<double> shape;
  Eigen::VectorXd linear, torque;
  double explained = -std::numeric_limits<double>::infinity();
};

ShapeFit fit_of(Effect const& effect, std::vector<double> const& shape, EffectInput const& input,
                Eigen::VectorXd const& left) {
  Eigen::MatrixXd columns(input.size(), static_cast<Index>(effect.n_linear()));
  effect.columns(input, shape, columns);
  if (!columns.allFinite()) return {};
  Eigen::VectorXd const right = columns.transpose() * left;
  Eigen::VectorXd linear = solve_shortest(Eigen::MatrixXd(columns.transpose() * columns), right);
  for (Index k = 0; k < linear.size(); ++k)
    if (effect.parameters()[static_cast<std::size_t>(k)].sign() == Sign::non_negative)
      linear[k] = std::max(linear[k], 0.0);
  Eigen::VectorXd torque = columns * linear;
  double const explained = left.squaredNorm() - (left - torque).squaredNorm();
  return {shape, linear, torque, explained};
}

}  // namespace

std::vector<ModelEffect> with_first_shapes(std::vector<ModelEffect> effects, Motion const& motion,
                                           FittedBaseline const& baseline, Eigen::VectorXd left) {
  EffectInput const input = baseline.input(motion);
  for (auto& given : effects) {
    Effect const& effect = *given.effect;
    auto const ranges = effect.shape_bounds(baseline.scales);
    std::vector<double> shape;
    std::optional<std::size_t> open;
    for (std::size_t k = 0; k < effect.n_shape(); ++k) {
      auto const value = given.values.find(effect.parameters()[effect.n_linear() + k].name);
      shape.push_back(value != given.values.end() ? value->second : middle_of(ranges[k]));
      if (value == given.values.end() && !open) open = k;
    }
    ShapeFit best;
    std::vector<double> const grid =
        open ? grid_of(effect.parameters()[effect.n_linear() + *open], ranges[*open], baseline.scales)
             : std::vector<double>{0.0};
    for (double const value : grid) {
      if (open) shape[*open] = value;
      ShapeFit tried = fit_of(effect, shape, input, left);
      if (tried.explained > best.explained) best = std::move(tried);
    }
    if (best.torque.size() == 0) continue;  // none of its columns is finite
    left -= best.torque;
    if (open) given.values.emplace(effect.parameters()[effect.n_linear() + *open].name, best.shape[*open]);
    for (std::size_t k = 0; k < effect.n_linear(); ++k)
      given.values.emplace(effect.parameters()[k].name, best.linear[static_cast<Index>(k)]);
  }
  return effects;
}

}  // namespace torquescope
