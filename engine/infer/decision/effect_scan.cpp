#include "engine/infer/decision/effect_scan.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

std::vector<bool> signs(Effect const& effect) {
  std::vector<bool> non_negative(effect.n_linear());
  for (std::size_t k = 0; k < non_negative.size(); ++k)
    non_negative[k] = effect.parameters()[k].sign() == Sign::non_negative;
  return non_negative;
}

// derivatives of the accepted effects' torque by their shapes
Eigen::MatrixXd shape_tangents(ModelOnStrips const& on, TreatedFit const& fit) {
  auto const& model = on.model();
  std::vector<Eigen::VectorXd> found;
  for (std::size_t i = 0; i < model.effects().size(); ++i) {
    auto const& [effect, shape] = model.effects()[i];
    auto const ranges = effect->shape_bounds(model.reference().scales);
    auto const width = static_cast<Eigen::Index>(effect->n_linear());
    Eigen::VectorXd const linear = fit.parameters.segment(static_cast<Eigen::Index>(model.first_parameter(i)), width);
    std::vector<std::vector<double>> shapes{shape};
    for (std::size_t k = 0; k < shape.size(); ++k) {
      shapes.push_back(shape);
      shapes.back()[k] += shape_step(ranges[k], shape[k]);
    }
    std::vector<EffectColumnsOnStrip> columns;
    for (std::size_t s = 0; s < on.strips().size(); ++s)
      columns.push_back(columns_of(*effect, shapes, on.strips()[s], on.baseline(s)));
    Eigen::MatrixXd const all = columns_on_rows(on.strips(), columns, fit.samples);
    Eigen::VectorXd const here = all.leftCols(width) * linear;
    for (std::size_t k = 0; k < shape.size(); ++k) {
      double const step = shape_step(ranges[k], shape[k]);
      if (step == 0.0) continue;
      auto const first = width * static_cast<Eigen::Index>(k + 1);
      found.emplace_back((all.middleCols(first, width) * linear - here) / step);
    }
  }
  Eigen::MatrixXd tangents(on.rows(), static_cast<Eigen::Index>(found.size()));
  for (std::size_t k = 0; k < found.size(); ++k) tangents.col(static_cast<Eigen::Index>(k)) = found[k];
  return tangents;
}

constexpr std::size_t columns_at_once = 16;

// each signal's best point of one effect
std::vector<EffectFinding> best_points(EffectQuestion const& question, FittedStrips const& fitted, Score const& score) {
  Effect const& effect = *question.effect;
  std::vector<EffectFinding> best(static_cast<std::size_t>(score.signals().cols()));
  for (auto& one : best) one.left = std::numeric_limits<double>::infinity();
  std::size_t const at_once = std::max<std::size_t>(1, columns_at_once / effect.n_linear());
  for (std::size_t first = 0; first < question.grid.size(); first += at_once) {
    std::vector<std::vector<double>> shapes;
    for (std::size_t p = first; p < std::min(question.grid.size(), first + at_once); ++p)
      shapes.push_back(question.grid.point(p));
    auto const groups = orthonormal_groups(effect_on_rows(fitted, effect, shapes), score.basis(), signs(effect));
    for (std::size_t p = 0; p < groups.size(); ++p) {
      Eigen::VectorXd const left = score.left_with(groups[p]);
      for (std::size_t s = 0; s < best.size(); ++s)
        if (left[static_cast<Eigen::Index>(s)] < best[s].left)
          best[s] = {first + p, left[static_cast<Eigen::Index>(s)], 0.0};
    }
  }
  return best;
}

double gain_at(EffectQuestion const& question, std::size_t point, FittedStrips const& fitted, Score const& score,
               Eigen::Index signal) {
  return score.gain(effect_group(fitted, score.basis(), *question.effect, question.grid.point(point)), signal);
}

}  // namespace

FittedStrips::FittedStrips(JointModel const& model, SharedStrips strips, DelayChoice const& delay)
    : strips_(std::move(strips)),
      on_(std::make_unique<ModelOnStrips>(model, std::span<Strip const>(*strips_))),
      chosen_(chosen_treatment(*on_, delay)),
      residual_(chosen_.fit.residual),
      parameters_(chosen_.fit.parameters) {
  Eigen::MatrixXd const of_shapes = shape_tangents(*on_, chosen_.fit);
  base_.resize(on_->rows(), chosen_.fit.columns.cols() + 2 + of_shapes.cols());
  base_ << chosen_.fit.columns, delay_tangent(*on_, chosen_.fit), sticking_on_rows(*on_, chosen_.fit), of_shapes;
}

void FittedStrips::add_noise(Eigen::VectorXd const& noise) {
  Eigen::VectorXd const step = solve_scaled(chosen_.fit.columns, noise).col(0);
  parameters_ += step;
  residual_ += noise - chosen_.fit.columns * step;
}

Eigen::Index FittedStrips::guard() const { return strips_->front().memory(); }

Eigen::MatrixXd effect_on_rows(FittedStrips const& fitted, Effect const& effect,
                               std::vector<std::vector<double>> const& shapes) {
  std::vector<EffectColumnsOnStrip> columns;
  for (std::size_t s = 0; s < fitted.strips().size(); ++s)
    columns.push_back(columns_of(effect, shapes, fitted.strips()[s], fitted.on().baseline(s)));
  return columns_on_rows(fitted.strips(), columns, fitted.chosen().fit.samples);
}

OrthonormalGroup effect_group(FittedStrips const& fitted, Eigen::MatrixXd const& basis, Effect const& effect,
                              std::vector<double> const& shape) {
  return orthonormal_group(effect_on_rows(fitted, effect, {shape}), basis, signs(effect));
}

std::vector<EffectQuestion> effect_questions(std::vector<Effect const*> const& effects, JointScales const& scales,
                                             double shortest) {
  std::vector<EffectQuestion> questions;
  for (auto const* effect : effects) {
    EffectQuestion question{effect, shape_grid(*effect, scales), scales};
    std::vector<std::vector<double>> axes = question.grid.axes;
    bool is_shorter = false;
    for (std::size_t k = 0; k < axes.size(); ++k)
      if (effect->parameters()[effect->n_linear() + k].lower.to == RelativeTo::resolution) {
        std::erase_if(axes[k], [&](double way) { return way < shortest; });
        question.grid.ranges[k].lower = std::max(question.grid.ranges[k].lower, shortest);
        is_shorter = true;
      }
    if (std::any_of(axes.begin(), axes.end(), [](auto const& axis) { return axis.empty(); })) continue;
    if (is_shorter) question.grid = grid_over(question.grid.ranges, axes, GridPoints::lattice);
    ShapeGrid const whole = question.grid;
    question.grid.places.clear();
    for (std::size_t point = 0; point < whole.size(); ++point)
      if (effect->is_plausible(whole.point(point), scales)) question.grid.places.push_back(whole.places[point]);
    if (!question.grid.places.empty()) questions.push_back(std::move(question));
  }
  return questions;
}

void compare_columns(std::vector<EffectQuestion>& questions, FittedStrips const& recording,
                     FittedStrips const& replicate, double most_change) {
  Eigen::MatrixXd const basis = orthonormal_basis(recording.base());
  for (auto& question : questions) {
    std::vector<std::vector<double>> shapes;
    std::size_t const last = question.grid.size() - 1;
    for (std::size_t const point : {std::size_t{0}, last / 2, last}) shapes.push_back(question.grid.point(point));
    Eigen::MatrixXd own = effect_on_rows(recording, *question.effect, shapes);
    Eigen::MatrixXd change = effect_on_rows(replicate, *question.effect, shapes) - own;
    own -= basis * (basis.transpose() * own);
    change -= basis * (basis.transpose() * change);
    question.is_same_for_all = true;
    for (Eigen::Index k = 0; k < own.cols(); ++k)
      question.is_same_for_all =
          question.is_same_for_all && change.col(k).squaredNorm() <= most_change * own.col(k).squaredNorm();
  }
}

std::vector<EffectFinding> scan_recording(std::vector<EffectQuestion> const& questions, FittedStrips const& recording,
                                          Score const& score, int threads) {
  std::vector<EffectFinding> found(questions.size());
  parallel_for(questions.size(), threads, [&](std::size_t i, int) {
    found[i] = best_points(questions[i], recording, score).front();
    found[i].gain = gain_at(questions[i], found[i].point, recording, score, 0);
  });
  return found;
}

Eigen::MatrixXd gains_of_replicates(std::vector<EffectQuestion> const& questions, FittedStrips const& recording,
                                    std::span<FittedStrips const> replicates, FoldKind kind, int threads) {
  auto const m = static_cast<Eigen::Index>(replicates.size());
  Eigen::MatrixXd signals(recording.residual().size(), m);
  for (Eigen::Index t = 0; t < m; ++t) signals.col(t) = replicates[static_cast<std::size_t>(t)].residual();
  Score const together(recording.base(), signals, recording.guard(), kind);
  Eigen::MatrixXd gains(static_cast<Eigen::Index>(questions.size()), m);
  parallel_for(questions.size(), threads, [&](std::size_t i, int) {
    if (!questions[i].is_same_for_all) return;
    auto const best = best_points(questions[i], recording, together);
    for (Eigen::Index t = 0; t < m; ++t)
      gains(static_cast<Eigen::Index>(i), t) =
          gain_at(questions[i], best[static_cast<std::size_t>(t)].point, recording, together, t);
  });
  parallel_for(replicates.size(), threads, [&](std::size_t t, int) {
    FittedStrips const& replicate = replicates[t];
    Score const own(replicate.base(), replicate.residual(), replicate.guard(), kind);
    for (std::size_t i = 0; i < questions.size(); ++i) {
      if (questions[i].is_same_for_all) continue;
      auto const best = best_points(questions[i], replicate, own).front();
      gains(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(t)) =
          gain_at(questions[i], best.point, replicate, own, 0);
    }
  });
  return gains;
}

}  // namespace torquescope
