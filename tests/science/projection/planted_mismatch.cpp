#include "science/projection/planted_mismatch.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "engine/infer/search/shape_grid.hpp"
#include "unit/replicates/clean_records.hpp"

namespace torquescope::test {
namespace {

constexpr std::uint64_t seed = 1;
constexpr std::size_t twins = 24;

Recording clean_recording(std::uint32_t number) {
  auto joint = clean_joint();
  joint.plan.simulation.duration_s = 4.0;
  return recorded(simulate_joint(joint.plan, number));
}

double rms(Eigen::VectorXd const& signal) {
  return std::sqrt(signal.squaredNorm() / static_cast<double>(signal.size()));
}

double torque_rms(CandidateColumns const& columns) { return rms(columns.comparison().rows.torque); }

RandomStream law_of(std::uint32_t recording, Effect const& effect) {
  auto const& all = effect_choices();
  auto const place = static_cast<std::uint32_t>(std::find(all.begin(), all.end(), &effect) - all.begin());
  return {{seed, recording, RandomDomain::test}, 0, place};
}

}  // namespace

CleanStage::CleanStage(std::uint32_t number_, int threads)
    : number(number_),
      recording(clean_recording(number_)),
      filter(clean_filter()),
      stage(
          make_stage({recording, clean_regressor(), filter, section, twins, seed, threads}, clean_regressor()).value()),
      columns(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters()) {}

PlantedMismatch planted_mismatch(CleanStage const& clean, Effect const& effect) {
  constexpr double from = 0.2, to = 0.8;
  constexpr double most_share = 0.5;  // of the plausible bounds, so that the best may lie above the truth
  constexpr int most_draws = 1000;
  auto const& columns = clean.columns;
  Eigen::VectorXd const left = clean.stage.mismatch();
  auto const shapes = effect.shape_bounds(columns.scales());
  auto const box = linear_box(columns, effect);
  RandomStream random = law_of(clean.number, effect);
  PlantedMismatch planted{&columns,
                          &effect,
                          std::vector<double>(shapes.size()),
                          Eigen::VectorXd(std::ssize(box)),
                          {},
                          clean.stage.parameters()};
  for (int draw = 0; draw < most_draws; ++draw) {
    for (std::size_t k = 0; k < shapes.size(); ++k) planted.shape[k] = from_unit(shapes[k], random.uniform(from, to));
    for (std::size_t k = 0; k < box.size(); ++k) {
      double const sign = box[k].lower < 0.0 && random.uniform() < 0.5 ? -1.0 : 1.0;
      planted.linear[static_cast<Eigen::Index>(k)] = sign * box[k].upper;
    }
    Eigen::VectorXd const torque = columns.columns(effect, planted.shape) * planted.linear;
    Eigen::MatrixXd const& known = columns.nuisance();
    Eigen::VectorXd const beyond = torque - known * (known.transpose() * torque);
    double const share = loudness * rms(left) / rms(beyond);
    if (!(share <= most_share)) continue;
    planted.linear *= share;
    planted.mismatch = left + share * torque;
    return planted;
  }
  throw std::runtime_error(effect.name() + " cannot be as loud within its bounds");
}

std::vector<ParameterRange> linear_box(CandidateColumns const& columns, Effect const& effect) {
  std::vector<double> middle;
  for (auto const& range : effect.shape_bounds(columns.scales())) middle.push_back(from_unit(range, 0.5));
  Eigen::MatrixXd const there = columns.columns(effect, middle);
  auto box = effect.linear_bounds(columns.scales());
  for (std::size_t k = 0; k < box.size(); ++k) {
    double const most = torque_rms(columns) / rms(there.col(static_cast<Eigen::Index>(k)));
    if (!std::isfinite(box[k].lower)) box[k].lower = -most;
    if (!std::isfinite(box[k].upper)) box[k].upper = most;
  }
  return box;
}

std::vector<ParameterRange> baseline_box(PlantedMismatch const& planted) {
  constexpr double least_share = 0.1;
  Eigen::MatrixXd const& model = planted.columns->model_columns();
  std::vector<ParameterRange> box;
  for (Eigen::Index k = 0; k < model.cols(); ++k) {
    double const least = least_share * torque_rms(*planted.columns) / rms(model.col(k));
    double const most = std::max(std::abs(planted.baseline[k]), least);
    box.push_back({-most, most});
  }
  return box;
}

}  // namespace torquescope::test
