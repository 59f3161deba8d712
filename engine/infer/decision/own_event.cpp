#include "engine/infer/decision/own_event.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/random_stream.hpp"
#include "engine/fit/optim/pattern_search.hpp"
#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/fit/statistics/replicate_null.hpp"
#include "engine/infer/decision/shape_grid.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index event_replicates = 99;  // a level of a hundredth can be told

// orthonormal bases of the columns at every point
std::vector<MatrixXd> bases_on(ShapeGrid const& grid, ColumnsOfShapes const& columns_at) {
  constexpr std::size_t points_at_once = 16;
  std::vector<MatrixXd> bases;
  for (std::size_t first = 0; first < grid.size(); first += points_at_once) {
    std::vector<std::vector<double>> shapes;
    for (std::size_t k = first; k < std::min(grid.size(), first + points_at_once); ++k) shapes.push_back(grid.point(k));
    for (auto const& columns : columns_at(shapes)) bases.push_back(orthonormal_basis(columns));
  }
  return bases;
}

// the energy that each signal's best point explains
VectorXd most_explained(std::vector<MatrixXd> const& bases, MatrixXd const& signals) {
  VectorXd most = VectorXd::Zero(signals.cols());
  for (auto const& basis : bases)
    if (basis.cols() > 0)
      most = most.cwiseMax((basis.transpose() * signals).colwise().squaredNorm().transpose().eval());
  return most;
}

// `left` with every stretch turned over at random
MatrixXd turned_over(VectorXd const& left, EventQuestion const& question) {
  MatrixXd all(left.size(), event_replicates);
  // stretches longer than the memory leave more of what repeats itself for long
  constexpr Index most_stretches = 60;
  auto const stretches =
      equal_blocks(left.size(), std::clamp<Index>(left.size() / question.memory_rows, 1, most_stretches));
  for (Index r = 0; r < event_replicates; ++r) {
    RandomStream random({question.seed, 1, RandomDomain::resampling}, 0, static_cast<std::uint32_t>(r + 1));
    for (auto const& stretch : stretches) {
      double const sign = random.bits() >> 63 ? -1.0 : 1.0;
      all.col(r).segment(stretch.from, stretch.size()) = sign * left.segment(stretch.from, stretch.size());
    }
  }
  return all;
}

VectorXd without(VectorXd const& left, MatrixXd const& basis) {
  return basis.cols() > 0 ? VectorXd(left - basis * (basis.transpose() * left)) : left;
}

}  // namespace

std::optional<OwnEvent> own_event(EventQuestion const& question, ColumnsOfShapes const& columns_at,
                                  VectorXd const& left) {
  constexpr int most_evaluations = 60;
  ShapeGrid const grid = shape_grid(*question.effect, question.scales);
  std::vector<MatrixXd> const bases = bases_on(grid, columns_at);
  std::size_t best = 0;
  double most = 0.0;
  for (std::size_t k = 0; k < bases.size(); ++k)
    if (double const here = most_explained({bases[k]}, left)[0]; here > most) {
      most = here;
      best = k;
    }
  if (!(most > 0.0)) return std::nullopt;
  VectorXd const chance = most_explained(bases, turned_over(without(left, bases[best]), question));
  if (empirical_p(most, {chance.data(), static_cast<std::size_t>(chance.size())}) > question.alpha) return std::nullopt;
  auto const left_at = [&](std::vector<double> const& unit) {
    return without(left, orthonormal_basis(columns_at({grid.from_unit_scale(unit)}).front())).squaredNorm();
  };
  LowestPoint const lowest = pattern_search({grid.to_unit_scale(grid.point(best)), left.squaredNorm() - most},
                                            grid.half_steps(), most_evaluations, left_at);
  OwnEvent event{grid.from_unit_scale(lowest.at), {}};
  event.columns = columns_at({event.shape}).front();
  return event;
}

JointScales scales_during(JointScales scales, Eigen::Ref<VectorXd const> const& time_s) {
  scales.start_s = time_s[0];
  scales.duration_s = time_s[time_s.size() - 1] - time_s[0];
  return scales;
}

}  // namespace torquescope
