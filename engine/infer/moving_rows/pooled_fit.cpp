#include "engine/infer/moving_rows/pooled_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/fit/statistics/block_jackknife.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

// columns of the model, then tangents of its shapes, of all recordings
Eigen::MatrixXd stacked_model(TrainingRows const& training) {
  Eigen::MatrixXd const first = training.columns().with_tangents();
  Eigen::MatrixXd all(training.basis().rows(), first.cols());
  all.topRows(first.rows()) = first;
  for (std::size_t i = 0; i < training.further().size(); ++i) {
    RowBlock const rows = training.recordings()[i + 1].rows;
    all.middleRows(rows.from, rows.size()) = training.further()[i].model;
  }
  return all;
}

CoefficientBounds unbounded(Eigen::Index n) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {Eigen::VectorXd::Constant(n, -infinity), Eigen::VectorXd::Constant(n, infinity)};
}

// what cannot be negative does not become so
CoefficientBounds room_below(ModelStage const& stage) {
  CoefficientBounds room = unbounded(stage.parameters().size());
  if (!stage.pipeline->bounds_effects()) return room;
  auto const& effects = stage.model().effects();
  for (std::size_t i = 0; i < effects.size(); ++i)
    for (std::size_t k = 0; k < effects[i].effect->n_linear(); ++k) {
      auto const at = static_cast<Eigen::Index>(stage.model().first_parameter(i) + k);
      if (effects[i].effect->parameters()[k].sign() == Sign::non_negative)
        room.lower[at] = -std::max(0.0, stage.parameters()[at]);
    }
  return room;
}

}  // namespace

std::optional<PooledFit> pooled_fit(ModelStage const& stage, TrainingRows const& training) {
  if (training.further().empty() || !stage.comparison.recording.held.empty()) return std::nullopt;
  Eigen::MatrixXd const model = stacked_model(training);
  Eigen::Index const p = stage.parameters().size(), m = training.signals() - 1;
  Eigen::MatrixXd const signals = training.basis_and_signals().rightCols(m + 1);
  PooledFit fit;
  fit.parameters = stage.parameters() + solve_scaled(model.leftCols(p), signals.col(0), room_below(stage)).col(0);
  auto const n = static_cast<double>(m);
  double const drawn_out = std::sqrt((n + 1.0) / (n - 1.0));  // as exchangeable() scales replicates
  fit.deviations = solve_scaled(model, signals.rightCols(m) / drawn_out);
  Eigen::MatrixXd const fits = stage.comparison.twin_fits.transpose();
  fit.jackknife = jackknife_deviations(signals.col(0), model, unbounded(model.cols()));
  fit.deviations.topRows(p) += fits.colwise() - fits.rowwise().mean().eval();
  return fit;
}

}  // namespace torquescope
