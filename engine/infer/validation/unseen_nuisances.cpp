#include "engine/infer/validation/unseen_nuisances.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/effects/carry_over.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/infer/pipeline/motion_limits.hpp"
#include "engine/infer/search/own_event.hpp"
#include "engine/simulate/autoregression.hpp"

namespace torquescope {
namespace {

// rows of the head on which nuisances are refitted
Eigen::Index head_rows(Eigen::Index rows) {
  constexpr Eigen::Index head_share = 20, fewest = 50;
  return std::min(rows, std::max(fewest, rows / head_share));
}

// whether a refit that leaves `least` of the head is beyond chance: three standard deviations; neighbours repeat each
// other
bool gains_beyond_chance(Eigen::Ref<Eigen::VectorXd const> const& head, double least) {
  constexpr double beyond = 9.0;
  double const r = std::clamp(autocorrelation(head, 1), 0.0, 0.99);
  double const variance = least / static_cast<double>(head.size()) * (1.0 + r) / (1.0 - r);
  return head.squaredNorm() - least > beyond * variance;
}

// Where a counter begins to count is another place in each recording: a wave keeps its size and order and may turn its
// phase, to the one that fits the head best, when that is beyond chance. left: beside the wave as it is now
bool turn_phase(Eigen::MatrixXd const& wave, Eigen::VectorXd const& left, double size,
                Eigen::Ref<Eigen::VectorXd> amplitudes) {
  constexpr int directions = 360;
  Eigen::Index const n = head_rows(left.size());
  Eigen::MatrixXd const head = wave.topRows(n);
  Eigen::VectorXd const wanted = left.head(n) + head * amplitudes;
  Eigen::Vector2d best = amplitudes;
  double least = left.head(n).squaredNorm();
  for (int k = 0; k < directions; ++k) {
    double const angle = 2.0 * std::numbers::pi * k / directions;
    Eigen::Vector2d const turned(size * std::cos(angle), size * std::sin(angle));
    double const energy = (wanted - head * turned).squaredNorm();
    if (energy >= least) continue;
    least = energy;
    best = turned;
  }
  if (!gains_beyond_chance(left.head(n), least)) return false;
  amplitudes = best;
  return true;
}

// A wave per second may be there or not: it begins at nothing, one over a counter at what it was
void turn_waves(ModelStage const& stage, ProcessedRecord const& record, Eigen::VectorXd& parameters,
                std::vector<std::string>& nuisances) {
  auto const& effects = stage.model().effects();
  for (std::size_t i = 0; i < effects.size(); ++i) {
    CarryOver const over = carry_over(*effects[i].effect);
    if (over != CarryOver::with_another_phase && over != CarryOver::in_frequency) continue;
    auto const first = static_cast<Eigen::Index>(stage.model().first_parameter(i));
    Eigen::VectorXd const left = record.torque - record.columns * parameters;
    double const size = stage.estimate().segment(first, 2).norm();
    if (turn_phase(record.columns.middleCols(first, 2), left, size, parameters.segment(first, 2)))
      nuisances.push_back("phase of " + effects[i].effect->name() + " refitted on the first 5 %");
    else if (over == CarryOver::in_frequency)
      nuisances.push_back(effects[i].effect->name() + " left out: the first 5 % do not show it");
  }
}

// How cold the joint still was is a share of what it was in training: the one that fits the head best, when that is
// beyond chance
bool scale_to_head(Eigen::MatrixXd const& columns, Eigen::VectorXd const& left,
                   Eigen::Ref<Eigen::VectorXd> parameters) {
  Eigen::Index const n = head_rows(left.size());
  Eigen::VectorXd const own = columns.topRows(n) * parameters, wanted = left.head(n) + own;
  if (!(own.squaredNorm() > 0.0)) return false;
  double const share = std::clamp(own.dot(wanted) / own.squaredNorm(), 0.0, 1.0);
  double const least = (wanted - share * own).squaredNorm();
  if (!gains_beyond_chance(left.head(n), least)) return false;
  parameters *= share;
  return true;
}

void scale_clocks(ModelStage const& stage, ProcessedRecord const& record, Eigen::VectorXd& parameters,
                  std::vector<std::string>& nuisances) {
  auto const& effects = stage.model().effects();
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (carry_over(*effects[i].effect) != CarryOver::in_part) continue;
    auto const first = static_cast<Eigen::Index>(stage.model().first_parameter(i));
    auto const width = static_cast<Eigen::Index>(effects[i].effect->n_linear());
    Eigen::VectorXd const left = record.torque - record.columns * parameters;
    if (scale_to_head(record.columns.middleCols(first, width), left, parameters.segment(first, width)))
      nuisances.push_back("how far " + effects[i].effect->name() + " had gone refitted on the first 5 %");
  }
}

char const* why_left_out(Effect const& effect) {
  if (effect.is_event()) return " left out: its instant belongs to the training recording";
  return " left out: where a channel's zero goes is another in each recording";
}

}  // namespace

Eigen::VectorXd transferable(ModelStage const& stage) {
  Eigen::VectorXd parameters = stage.estimate();
  auto const& effects = stage.model().effects();
  for (std::size_t i = 0; i < effects.size(); ++i) {
    Effect const& effect = *effects[i].effect;
    CarryOver const over = carry_over(effect);
    if (over != CarryOver::none && over != CarryOver::in_frequency) continue;
    parameters
        .segment(static_cast<Eigen::Index>(stage.model().first_parameter(i)),
                 static_cast<Eigen::Index>(effect.n_linear()))
        .setZero();
  }
  return parameters;
}

void refit_on_head(ModelStage const& stage, ProcessedRecord const& record, Eigen::VectorXd& parameters,
                   std::vector<std::string>& nuisances) {
  turn_waves(stage, record, parameters, nuisances);
  scale_clocks(stage, record, parameters, nuisances);
}

ModelElsewhere with_own_events(ModelStage const& stage, RecordPipeline const& pipeline, ProcessedRecord const& record,
                               ModelElsewhere there, std::uint64_t seed, std::vector<std::string>& nuisances) {
  auto const& effects = stage.model().effects();
  auto const is_asked = [](ShapedEffect const& one) { return carry_over(*one.effect) == CarryOver::none; };
  if (std::none_of(effects.begin(), effects.end(), is_asked)) return there;
  Eigen::VectorXd left = record.torque - record.columns * there.parameters;
  // the recording's own offset: means say nothing, of the residual as of the columns
  bool const has_own_offset = moves_both_ways(pipeline.picked(record.motion->dq, record));
  if (has_own_offset) left.array() -= left.mean();
  FittedBaseline const baseline = on_motion(stage.model().regressor(), stage.model().reference(), record.motion);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    Effect const& effect = *effects[i].effect;
    if (!is_asked(effects[i])) continue;
    auto const width = static_cast<Eigen::Index>(effect.n_linear());
    auto const columns_at = [&](std::vector<std::vector<double>> const& shapes) {
      std::vector<Eigen::MatrixXd> each;
      for (auto const& shape : shapes) {
        Eigen::MatrixXd signals(record.motion->q.size(), width);
        effect.columns(baseline.input(record.motion), shape, signals);
        each.push_back(pipeline.filtered_columns(signals, record));
        if (has_own_offset) each.back().rowwise() -= each.back().colwise().mean().eval();
      }
      return each;
    };
    EventQuestion const question{
        .effect = &effect,
        .scales = scales_during(stage.model().reference().scales, record.motion->time_s),
        .memory_rows = guard_rows(pipeline),
        .seed = seed};
    auto const own = own_event(question, columns_at, left);
    if (!own) {
      nuisances.push_back(effect.name() + why_left_out(effect));
      continue;
    }
    Eigen::VectorXd const size = solve_scaled(own->columns, left);
    left -= own->columns * size;
    there.model = there.model.with_shape(i, own->shape);
    there.parameters.segment(static_cast<Eigen::Index>(stage.model().first_parameter(i)), width) = size;
    nuisances.push_back(effect.name() + " at a time and of a size of its own, fitted to all of its rows");
  }
  return there;
}

double head_offset(Eigen::VectorXd const& residual, Eigen::VectorXd const& velocity) {
  constexpr double beyond = 3.0;
  if (!moves_both_ways(velocity.head(head_rows(velocity.size())))) return 0.0;
  Eigen::Index const n = head_rows(residual.size());
  Eigen::VectorXd const head = residual.head(n);
  double const mean = head.mean();
  Eigen::VectorXd const apart = head.array() - mean;
  // neighbours repeat each other: an autoregression of order 1 says how often
  double const r = std::clamp(autocorrelation(apart, 1), 0.0, 0.99);
  double const error =
      std::sqrt(apart.squaredNorm() / static_cast<double>(n - 1) * (1.0 + r) / (1.0 - r) / static_cast<double>(n));
  return std::abs(mean) > beyond * error ? mean : 0.0;
}

}  // namespace torquescope
