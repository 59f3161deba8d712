#include "engine/infer/decision/row_weights.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/infer/decision/replicate_strips.hpp"
#include "engine/simulate/replicate_lanes.hpp"

namespace torquescope {
namespace {

constexpr std::uint32_t step_of_weights = 1024;  // of the same seed, beyond those of a search

std::vector<Strip> unweighed(std::vector<Strip> strips) {
  for (auto& strip : strips) strip.row_weight.resize(0);
  return strips;
}

Eigen::VectorXd smoothed(Eigen::VectorXd const& values) {
  Eigen::Index const n = values.size();
  Eigen::VectorXd smooth(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index const first = std::max<Eigen::Index>(k - 1, 0), last = std::min<Eigen::Index>(k + 1, n - 1);
    smooth[k] = values.segment(first, last - first + 1).mean();
  }
  return smooth;
}

// of the half of the rows where replicates leave least
double noise_square(Eigen::VectorXd const& residual, Eigen::VectorXd const& of_replicates) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(residual.size()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Eigen::Index>(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return of_replicates[a] < of_replicates[b]; });
  order.resize(std::max<std::size_t>(1, order.size() / 2));
  double sum = 0.0;
  for (Eigen::Index const row : order) sum += residual[row] * residual[row];
  return sum / static_cast<double>(order.size());
}

std::vector<Strip> weighed(DecisionQuestion const& question, std::span<Recording const> recordings,
                           FittedModel const& model, std::vector<Strip> strips) {
  if (strips.empty()) return strips;
  strips = unweighed(std::move(strips));
  // fitted to these recordings, each row counting alike
  FittedStrips const own(*model.model, share(strips), {DelaySearch::given, 0.0, model.fitted->chosen().late_s});
  ReplicateSetting const setting{
      recordings,    question.filter, plausible_sticking(own.on(), own.chosen(), question.numbers.sticking_odds),
      question.seed, step_of_weights, question.threads};
  std::vector<std::vector<Strip>> drawn(replicate_lanes);
  for (std::size_t i = 0; i < strips.size(); ++i) {
    auto made = ReplicateMaker(setting, i, own.on(), own.chosen()).strips(0, replicate_lanes);
    for (std::size_t t = 0; t < replicate_lanes; ++t) drawn[t].push_back(std::move(made[t]));
  }
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(own.on().rows());
  double count = 0.0;
  for (auto& replicate : drawn) {
    FittedStrips const fitted(*model.model, share(std::move(replicate)), free_delay(question.numbers));
    if (!fitted.residual().allFinite()) continue;
    squares += fitted.residual().cwiseAbs2();
    count += 1.0;
  }
  if (count == 0.0) return strips;
  squares /= count;
  Eigen::Index first = 0;
  for (auto& strip : strips) {
    auto const rows = static_cast<Eigen::Index>(strip.rows.size());
    Eigen::VectorXd const left = smoothed(squares.segment(first, rows));
    double const noise = noise_square(own.residual().segment(first, rows), left);
    if (noise > 0.0) strip.row_weight = (noise / (noise + left.array())).sqrt();
    first += rows;
  }
  return strips;
}

}  // namespace

JointStrips weighed_rows(DecisionQuestion const& question, JointStrips rows, FittedModel const& model) {
  rows.training = share(weighed(question, question.training, model, *rows.training));
  rows.validation = weighed(question, question.validation, model, std::move(rows.validation));
  count_torque(rows);
  return rows;
}

JointStrips unweighed_rows(JointStrips rows) {
  rows.training = share(unweighed(*rows.training));
  rows.validation = unweighed(std::move(rows.validation));
  count_torque(rows);
  return rows;
}

FittedModel fitted_alike(JointStrips const& rows, FittedModel const& model) {
  return fitted_at(rows, *model.model, model.fitted->chosen().late_s);
}

}  // namespace torquescope
