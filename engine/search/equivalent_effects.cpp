#include "engine/search/equivalent_effects.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/search/shapes_together.hpp"

namespace torquescope {
namespace {

// best point of the grid on a given signal, without any null
EffectScan best_on(CandidateColumns const& columns, Effect const& effect, Eigen::VectorXd const& signal, int threads) {
  EffectScan scan;
  scan.effect = &effect;
  scan.grid = shape_grid(effect, columns.scales());
  std::vector<BoundedGain> gains(scan.grid.size());
  for_shapes_together(gains.size(), threads, [&](std::size_t first, std::size_t last) {
    std::vector<std::vector<double>> shapes;
    for (std::size_t k = first; k < last; ++k) shapes.push_back(scan.grid.point(k));
    auto const groups = columns.group_of_each(effect, shapes);
    for (std::size_t k = first; k < last; ++k)
      gains[k] = bounded_gain(groups[k - first], groups[k - first].q.transpose() * signal);
  });
  auto const best =
      std::max_element(gains.begin(), gains.end(), [](auto const& a, auto const& b) { return a.gain < b.gain; });
  scan.best_point = static_cast<std::size_t>(best - gains.begin());
  scan.gain = best->gain;
  scan.parameters = best->parameters;
  scan.shape = scan.grid.point(scan.best_point);
  return scan;
}

// how often chance gives the accepted effect such an advantage when the rival is the truth
double chance_of_advantage(Eigen::MatrixXd const& accepted, Eigen::MatrixXd const& rival, Eigen::VectorXd const& signal,
                           Eigen::MatrixXd const& apart) {
  auto const advantage = [&](Eigen::VectorXd const& y) {
    return (accepted.transpose() * y).squaredNorm() - (rival.transpose() * y).squaredNorm();
  };
  double const seen = advantage(signal);
  Eigen::VectorXd const truth = rival * (rival.transpose() * signal);
  std::size_t reached = 1;
  for (Eigen::Index t = 0; t < apart.cols(); ++t) reached += advantage(truth + apart.col(t)) >= seen ? 1 : 0;
  return static_cast<double>(reached) / static_cast<double>(apart.cols() + 1);
}

}  // namespace

std::vector<Rival> rivals_of(ModelStage const& stage, std::size_t i, std::vector<Effect const*> const& others,
                             ShapeSearch const& search, int threads) {
  constexpr double common_level = 0.05;
  auto const& [effect, shape] = stage.model().effects()[i];
  CandidateColumns const columns(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters(), i);
  auto const first = static_cast<Eigen::Index>(stage.model().first_parameter(i));
  Eigen::VectorXd const linear = stage.parameters().segment(first, static_cast<Eigen::Index>(effect->n_linear()));
  Eigen::VectorXd const signal = stage.mismatch() + columns.columns(*effect, shape) * linear;
  Eigen::MatrixXd const apart = stage.comparison.rows.twins.colwise() - stage.comparison.rows.twin_mean;

  OrthonormalGroup const own = columns.group(*effect, shape);
  double const own_gain = bounded_gain(own, own.q.transpose() * signal).gain;
  double const left = std::max(0.0, stage.energy.excess);
  std::vector<Rival> rivals;
  for (auto const* other : others) {
    if (other == effect || !other->exists_on(columns.joint())) continue;
    RefinedEffect const refined =
        refine_shape(columns, best_on(columns, *other, signal, threads), signal, search, threads);
    OrthonormalGroup const group = columns.group(*other, refined.shape);
    if (group.rank() == 0 || !(refined.gain > 0.0) || !other->is_plausible(refined.shape, columns.scales())) continue;
    Rival rival{other, refined.shape, refined.gain / own_gain, 1.0, true};
    rival.p = chance_of_advantage(own.q, group.q, signal, apart);
    bool const as_good_but_for_form =
        rival.gain_ratio > nearly_as_good && (own_gain - refined.gain <= left || effect->is_event());
    rival.is_equivalent = as_good_but_for_form || rival.p > common_level;
    rivals.push_back(rival);
  }
  std::stable_sort(rivals.begin(), rivals.end(),
                   [](auto const& a, auto const& b) { return a.gain_ratio > b.gain_ratio; });
  return rivals;
}

}  // namespace torquescope
