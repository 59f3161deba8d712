#include "engine/infer/search/parameter_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/fit/statistics/block_jackknife.hpp"
#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/fit/statistics/profiled_interval.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/infer/locate/axis_blocks.hpp"
#include "engine/infer/search/law_discrepancy.hpp"

namespace torquescope {
namespace {

constexpr double two_sided = 1.96;

ParameterEstimate estimate(std::string name, std::string unit, double value, double half) {
  return {std::move(name), std::move(unit), value, value - half, value + half};
}

// how far shapes can go inside their bounds from where they are, and what has no negative sign towards none
CoefficientBounds room_of(ModelStage const& stage, CandidateColumns const& columns) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::Index at = columns.model_columns().cols();
  Eigen::Index const n = at + columns.tangents().cols();
  CoefficientBounds room{Eigen::VectorXd::Constant(n, -infinity), Eigen::VectorXd::Constant(n, infinity)};
  for (std::size_t i = 0; i < stage.model().effects().size(); ++i) {
    auto const& [effect, shape] = stage.model().effects()[i];
    auto const linear_at = static_cast<Eigen::Index>(stage.model().first_parameter(i));
    for (std::size_t k = 0; k < effect->n_linear(); ++k)
      if (effect->parameters()[k].sign() == Sign::non_negative && stage.pipeline->bounds_effects())
        room.lower[linear_at + static_cast<Eigen::Index>(k)] =
            -std::max(0.0, stage.parameters()[linear_at + static_cast<Eigen::Index>(k)]);
    auto const ranges = effect->shape_bounds(columns.scales());
    for (std::size_t k = 0; k < shape.size(); ++k, ++at) {
      room.lower[at] = std::min(0.0, ranges[k].lower - shape[k]);
      room.upper[at] = std::max(0.0, ranges[k].upper - shape[k]);
    }
  }
  return room;
}

// torque of twins apart from their mean: what the twin's own fit took up is put back, residual + columns (fit - mean
// fit)
Eigen::MatrixXd twins_apart(ModelStage const& stage, CandidateColumns const& columns) {
  auto const& rows = stage.comparison.rows;
  Eigen::MatrixXd const fits = stage.comparison.twin_fits.transpose();
  return (rows.twins.colwise() - rows.twin_mean) +
         columns.model_columns() * (fits.colwise() - fits.rowwise().mean().eval());
}

Eigen::VectorXd deviations_of(Eigen::MatrixXd const& steps) {
  auto const m = static_cast<double>(steps.cols());
  return (steps.rowwise().squaredNorm() / (m - 1.0) * (1.0 + 1.0 / m)).cwiseSqrt();
}

// the same of steps that a bound cuts on one side, as the other side says
Eigen::VectorXd deviations_of(Eigen::MatrixXd const& steps, CoefficientBounds const& room) {
  Eigen::VectorXd deviations = deviations_of(steps);
  Eigen::VectorXd const up = deviations_of(std::sqrt(2.0) * steps.cwiseMax(0.0)),
                        down = deviations_of(std::sqrt(2.0) * steps.cwiseMin(0.0));
  for (Eigen::Index k = 0; k < deviations.size(); ++k)
    if (-room.lower[k] < two_sided * deviations[k] || room.upper[k] < two_sided * deviations[k])
      deviations[k] = std::max(up[k], down[k]);
  return deviations;
}

// where leaving out a level of an effect's axis changes its parameters by more
void widen_by_levels(Eigen::VectorXd& half, ModelStage const& stage, CandidateColumns const& columns,
                     CoefficientBounds const& room) {
  constexpr Eigen::Index n_levels = 10;
  auto const& model = stage.model();
  Eigen::MatrixXd const all = columns.with_tangents();
  Eigen::VectorXd const mismatch = stage.mismatch();
  Eigen::Index shape_at = columns.model_columns().cols();
  for (std::size_t i = 0; i < model.effects().size(); ++i) {
    auto const& [effect, shape] = model.effects()[i];
    auto const linear_at = static_cast<Eigen::Index>(model.first_parameter(i));
    auto const n_linear = static_cast<Eigen::Index>(effect->n_linear()),
               n_shape = static_cast<Eigen::Index>(shape.size());
    Eigen::VectorXd const torque = columns.columns(*effect, shape) * stage.parameters().segment(linear_at, n_linear);
    auto const [order, blocks] = axis_blocks(*effect, stage.comparison.rows, torque, n_levels);
    if (!order.empty()) {
      Eigen::VectorXd const levels =
          jackknife_quantile * jackknife_deviations(mismatch(order), all(order, Eigen::all), room, blocks);
      half.segment(linear_at, n_linear) =
          half.segment(linear_at, n_linear).cwiseMax(levels.segment(linear_at, n_linear));
      half.segment(shape_at, n_shape) = half.segment(shape_at, n_shape).cwiseMax(levels.segment(shape_at, n_shape));
    }
    shape_at += n_shape;
  }
}

// half of the intervals: chance over twins, or what leaving out a tenth of the record changes when that is more; and
// what a law that leaves something may hide, which no chance is
Eigen::VectorXd half_intervals(ModelStage const& stage, CandidateColumns const& columns) {
  CoefficientBounds const room = room_of(stage, columns);
  Eigen::MatrixXd const all = columns.with_tangents();
  if (stage.pooled) {
    Eigen::VectorXd const wide =
        (two_sided * deviations_of(stage.pooled->deviations)).cwiseMax(jackknife_quantile * stage.pooled->jackknife);
    return (wide.array().square() + discrepancy_shifts(stage.energy, all, room).array().square()).sqrt();
  }
  Eigen::VectorXd const chance = two_sided * deviations_of(solve_scaled(all, twins_apart(stage, columns), room), room);
  Eigen::VectorXd const blocks = jackknife_quantile * jackknife_deviations(stage.mismatch(), all, room);
  Eigen::VectorXd half = chance.cwiseMax(blocks);
  widen_by_levels(half, stage, columns, room);
  return (half.array().square() + discrepancy_shifts(stage.energy, all, room).array().square()).sqrt();
}

// where on the recording, or on the travel: its column may not change at all, or jump
bool is_placed(EffectParameter const& parameter) {
  return parameter.is_instant() || (parameter.is_shape && parameter.lower.to == RelativeTo::position);
}

// what moving the instant, or the place, to both sides shows is wider where the motion does not tell it
void widen_placed(std::vector<ParameterEstimate>& estimates, ModelStage const& stage, std::size_t i) {
  Effect const* const effect = stage.model().effects()[i].effect;
  std::vector<double> const& shape = stage.model().effects()[i].shape;
  auto const& parameters = effect->parameters();
  std::size_t const n_linear = effect->n_linear();
  if (std::none_of(parameters.begin(), parameters.end(), is_placed)) return;
  CandidateColumns const beside(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters(), i);
  Eigen::VectorXd const linear = stage.parameters().segment(static_cast<Eigen::Index>(stage.model().first_parameter(i)),
                                                            static_cast<Eigen::Index>(n_linear));
  Eigen::VectorXd const signal = stage.mismatch() + beside.columns(*effect, shape) * linear;
  double const row_noise = stage.energy.noise / static_cast<double>(stage.comparison.rows.size());
  double const hidden = sure_excess(stage.energy);
  auto const bounds = effect->shape_bounds(beside.scales());
  for (std::size_t k = 0; k < shape.size(); ++k) {
    if (!is_placed(parameters[n_linear + k])) continue;
    auto const gain = [&, moved = shape](double at) mutable {
      moved[k] = at;
      OrthonormalGroup const group = beside.group(*effect, moved);
      return bounded_gain(group, group.q.transpose() * signal).gain;
    };
    auto& own = estimates[n_linear + k];
    double const least_step = 1e-6 * (bounds[k].upper - bounds[k].lower);
    auto const [from, to] =
        profiled_interval({shape[k], bounds[k].lower, bounds[k].upper, std::max(own.upper - own.value, least_step)},
                          row_noise, hidden, gain);
    own.lower = std::min(own.lower, from);
    own.upper = std::max(own.upper, to);
  }
}

// what is no less than nothing is so in its interval, too; instants and places are counted from somewhere
void cut_at_none(std::vector<ParameterEstimate>& estimates, Effect const& effect) {
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    auto const& parameter = effect.parameters()[k];
    if (parameter.lower.factor >= 0.0 && !is_placed(parameter) && estimates[k].value >= 0.0)
      estimates[k].lower = std::max(0.0, estimates[k].lower);
  }
}

// what the joint itself fixes was not measured
void drop_fixed(std::vector<ParameterEstimate>& estimates, Effect const& effect, JointScales const& scales) {
  auto const bounds = effect.shape_bounds(scales);
  for (std::size_t k = bounds.size(); k-- > 0;)
    if (!(bounds[k].upper > bounds[k].lower))
      estimates.erase(estimates.begin() + static_cast<std::ptrdiff_t>(effect.n_linear() + k));
}

}  // namespace

Eigen::VectorXd parameter_deviations(ModelStage const& stage, CandidateColumns const& columns) {
  return deviations_of(solve_scaled(columns.with_tangents(), twins_apart(stage, columns)));
}

ModelEstimate estimate_parameters(ModelStage const& stage) {
  CandidateColumns const columns(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters());
  Eigen::VectorXd const half = half_intervals(stage, columns);
  auto const& model = stage.model();
  ModelEstimate result;
  auto const owners = model.regressor().column_owners();
  for (std::size_t k = 0; k < owners.size(); ++k) {
    // corrections of what a recording came without are nobody's parameters
    if (model.regressor().terms()[owners[k].term]->is_given()) continue;
    result.baseline.push_back(estimate(owners[k].name, owners[k].unit, stage.estimate()[static_cast<Eigen::Index>(k)],
                                       half[static_cast<Eigen::Index>(k)]));
  }
  Eigen::Index shape_at = columns.model_columns().cols();
  for (std::size_t i = 0; i < model.effects().size(); ++i) {
    auto const& effect = *model.effects()[i].effect;
    auto const values = model.effect_parameters(i, stage.estimate());
    std::vector<ParameterEstimate> own;
    for (std::size_t k = 0; k < values.size(); ++k) {
      auto const& parameter = effect.parameters()[k];
      Eigen::Index const at =
          k < effect.n_linear() ? static_cast<Eigen::Index>(model.first_parameter(i) + k) : shape_at++;
      own.push_back(estimate(parameter.name, parameter.unit_for(model.regressor().joint()), values[k], half[at]));
    }
    widen_placed(own, stage, i);
    cut_at_none(own, effect);
    drop_fixed(own, effect, columns.scales());
    result.effects.push_back(std::move(own));
  }
  return result;
}

}  // namespace torquescope
