#include "engine/infer/search/candidate_columns.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

// a wave of fixed time frequency: the zero-phase filter changes its size alone, which a linear parameter takes up
bool is_fixed_frequency(Effect const& effect) {
  return effect.n_shape() == 1 && effect.parameters()[effect.n_linear()].is_frequency();
}

std::vector<bool> signs(Effect const& effect) {
  std::vector<bool> non_negative(effect.n_linear());
  for (std::size_t k = 0; k < non_negative.size(); ++k)
    non_negative[k] = effect.parameters()[k].sign() == Sign::non_negative;
  return non_negative;
}

}  // namespace

double shape_step(ParameterRange const& range, double value) {
  if (!(range.upper > range.lower)) return 0.0;
  constexpr double share = 1e-3;
  double const step = range.spacing == Spacing::logarithmic ? share * value : share * (range.upper - range.lower);
  return value + step <= range.upper ? step : -step;
}

CandidateColumns::CandidateColumns(RecordPipeline const& pipeline, TwinComparison const& comparison,
                                   BaselineReference reference, Eigen::VectorXd const& parameters, std::size_t without,
                                   DrivenBy driven_by)
    : pipeline_(&pipeline),
      comparison_(&comparison),
      record_(driven_by == DrivenBy::twin ? &comparison.common : &comparison.recording),
      reference_(std::move(reference)),
      baseline_(on_motion(pipeline.model().regressor(), reference_, record_->motion)),
      scan_(scan_motion_of_joint(pipeline, *record_, reference_)),
      scan_drive_(scan_motion_of_drive(pipeline, *record_, reference_)),
      model_columns_(record_->columns) {
  auto const& rows = comparison.rows;
  row_motion_ = {rows.rate_hz, rows.time_s, rows.q, rows.dq, rows.ddq, rows.model_torque};
  tangents_ = fill_tangents(parameters, without);
  if (without != none) {
    auto const& model = pipeline.model();
    auto const first = static_cast<Eigen::Index>(model.first_parameter(without));
    auto const width = static_cast<Eigen::Index>(model.effects()[without].effect->n_linear());
    Eigen::Index const after = model_columns_.cols() - first - width;
    model_columns_.middleCols(first, after) = model_columns_.rightCols(after).eval();
    model_columns_.conservativeResize(Eigen::NoChange, first + after);
  }
  nuisance_ = orthonormal_basis(with_tangents());
}

void CandidateColumns::add_nuisance(Eigen::MatrixXd const& signals) {
  Eigen::MatrixXd columns = pipeline_->filtered_columns(signals, *record_);
  pipeline_->whiten(columns, record_->kept_rows);
  Eigen::MatrixXd all(nuisance_.rows(), nuisance_.cols() + columns.cols());
  all << nuisance_, columns;
  nuisance_ = orthonormal_basis(all);
}

Eigen::MatrixXd CandidateColumns::with_tangents() const {
  Eigen::MatrixXd all(model_columns_.rows(), model_columns_.cols() + tangents_.cols());
  all << model_columns_, tangents_;
  return all;
}

EffectInput CandidateColumns::input_of(Effect const& effect) const {
  EffectInput input =
      effect.has_inertia() ? EffectInput{record_->drive, reference_.scales} : baseline_.input(record_->motion);
  input.given = reference_.given.get();
  return input;
}

// the columns of all shapes, one shape after the other
Eigen::MatrixXd CandidateColumns::plain_columns_of(Effect const& effect, std::vector<std::vector<double>> const& shapes,
                                                   LawRate rate) const {
  auto const linear = static_cast<Eigen::Index>(effect.n_linear());
  auto const count = static_cast<Eigen::Index>(shapes.size());
  if (is_fixed_frequency(effect)) {
    Eigen::MatrixXd all(record_->torque.size(), linear * count);
    effect.columns_of_shapes({row_motion_, reference_.scales}, shapes, all);
    return all;
  }
  // of a long recording a few at a time at the full rate: only their rows are kept
  constexpr Eigen::Index enough_columns = 8, most_numbers = 1'000'000;
  bool const is_full = rate == LawRate::full || needs_every_sample(effect);
  ScanMotion const* const scan = is_full ? nullptr : (effect.has_inertia() ? scan_drive_ : scan_).get();
  auto const filtered = [&](Eigen::MatrixXd const& signals) {
    return scan ? scan->filtered_columns(signals, record_->kept_rows) : pipeline_->filtered_columns(signals, *record_);
  };
  Eigen::Index const n = scan ? scan->samples() : record_->motion->q.size();
  Eigen::Index const columns_at_once = std::max(enough_columns, most_numbers / n);
  Eigen::Index const at_once = std::max<Eigen::Index>(1, columns_at_once / linear);
  EffectInput const input = scan ? scan->input() : input_of(effect);
  if (at_once >= count) {
    Eigen::MatrixXd all(n, linear * count);
    effect.columns_of_shapes(input, shapes, all);
    return filtered(all);
  }
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(record_->kept_rows.size()), linear * count);
  for (Eigen::Index first = 0; first < count; first += at_once) {
    Eigen::Index const now = std::min(at_once, count - first);
    Eigen::MatrixXd some(n, linear * now);
    effect.columns_of_shapes(input, {shapes.begin() + first, shapes.begin() + first + now}, some);
    rows.middleCols(linear * first, linear * now) = filtered(some);
  }
  return rows;
}

Eigen::MatrixXd CandidateColumns::columns_of(Effect const& effect,
                                             std::vector<std::vector<double>> const& shapes) const {
  Eigen::MatrixXd columns = plain_columns_of(effect, shapes);
  pipeline_->whiten(columns, record_->kept_rows);
  return columns;
}

Eigen::MatrixXd CandidateColumns::columns(Effect const& effect, std::span<double const> shape) const {
  return columns_of(effect, {{shape.begin(), shape.end()}});
}

Eigen::MatrixXd CandidateColumns::plain_columns(Effect const& effect, std::span<double const> shape) const {
  return plain_columns_of(effect, {{shape.begin(), shape.end()}});
}

Eigen::MatrixXd CandidateColumns::signals(Effect const& effect, std::span<double const> shape) const {
  Eigen::MatrixXd all(record_->motion->q.size(), static_cast<Eigen::Index>(effect.n_linear()));
  effect.columns(input_of(effect), shape, all);
  return all;
}

std::vector<OrthonormalGroup> CandidateColumns::groups(Effect const& effect,
                                                       std::vector<std::vector<double>> const& shapes) const {
  return orthonormal_groups(columns_of(effect, shapes), nuisance_, signs(effect));
}

OrthonormalGroup CandidateColumns::group(Effect const& effect, std::span<double const> shape) const {
  return orthonormal_group(columns(effect, shape), nuisance_, signs(effect));
}

std::vector<Eigen::MatrixXd> CandidateColumns::columns_of_each(Effect const& effect,
                                                               std::vector<std::vector<double>> const& shapes,
                                                               LawRate rate) const {
  auto const linear = static_cast<Eigen::Index>(effect.n_linear());
  Eigen::MatrixXd const plain = plain_columns_of(effect, shapes, rate);
  std::vector<Eigen::MatrixXd> each;
  for (Eigen::Index first = 0; first < plain.cols(); first += linear) {
    each.emplace_back(plain.middleCols(first, linear));
    pipeline_->whiten(each.back(), record_->kept_rows);
  }
  return each;
}

std::vector<OrthonormalGroup> CandidateColumns::group_of_each(Effect const& effect,
                                                              std::vector<std::vector<double>> const& shapes,
                                                              LawRate rate) const {
  std::vector<OrthonormalGroup> groups;
  for (auto& columns : columns_of_each(effect, shapes, rate))
    groups.push_back(orthonormal_group(std::move(columns), nuisance_, signs(effect)));
  return groups;
}

Eigen::MatrixXd CandidateColumns::fill_tangents(Eigen::VectorXd const& parameters, std::size_t without) const {
  auto const& model = pipeline_->model();
  std::vector<Eigen::VectorXd> found;
  for (std::size_t i = 0; i < model.effects().size(); ++i) {
    if (i == without) continue;
    auto const& [effect, shape] = model.effects()[i];
    auto const ranges = effect->shape_bounds(reference_.scales);
    auto const first = static_cast<Eigen::Index>(model.first_parameter(i));
    Eigen::VectorXd const linear = parameters.segment(first, static_cast<Eigen::Index>(effect->n_linear()));
    std::vector<std::vector<double>> shapes{shape};
    for (std::size_t k = 0; k < shape.size(); ++k) {
      shapes.push_back(shape);
      shapes.back()[k] += shape_step(ranges[k], shape[k]);
    }
    std::vector<Eigen::MatrixXd> const each = columns_of_each(*effect, shapes);
    Eigen::VectorXd const here = each.front() * linear;
    for (std::size_t k = 0; k < shape.size(); ++k) {
      double const step = shape_step(ranges[k], shape[k]);
      if (step == 0.0)  // no other value could be
        found.emplace_back(Eigen::VectorXd::Zero(here.size()));
      else
        found.emplace_back((each[k + 1] * linear - here) / step);
    }
  }
  Eigen::MatrixXd tangents(record_->torque.size(), static_cast<Eigen::Index>(found.size()));
  for (std::size_t k = 0; k < found.size(); ++k) tangents.col(static_cast<Eigen::Index>(k)) = found[k];
  return tangents;
}

}  // namespace torquescope
