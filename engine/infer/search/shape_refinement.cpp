#include "engine/infer/search/shape_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"
#include "engine/infer/search/shapes_together.hpp"

namespace torquescope {
namespace {

class Refinement {
 public:
  // begins at a point of the scan's grid
  Refinement(CandidateColumns const& columns, EffectScan const& scan, std::size_t point,
             Eigen::VectorXd const& mismatch, bool only_plausible = false)
      : columns_(columns),
        effect_(*scan.effect),
        ranges_(scan.grid.ranges),
        mismatch_(mismatch),
        only_plausible_(only_plausible) {
    best_.effect = scan.effect;
    auto const bounds = effect_.linear_bounds(columns.scales());
    least_.resize(static_cast<Eigen::Index>(bounds.size()));
    most_.resize(least_.size());
    for (std::size_t k = 0; k < bounds.size(); ++k) {
      least_[static_cast<Eigen::Index>(k)] = bounds[k].lower;
      most_[static_cast<Eigen::Index>(k)] = bounds[k].upper;
    }
    try_shape(scan.grid.point(point));
  }

  RefinedEffect take() && {
    best_.gain -= noise_at(best_.shape);
    if (effect_.has_plain_form()) best_.plain_gain = gain_at({}).gain - noise_at({});
    return std::move(best_);
  }

  // what a search finds is polished, even if the start explains more than that does before
  void forget_start() { best_.gain = -std::numeric_limits<double>::infinity(); }

  // a search looks at fewer samples than the fit
  void see_every_sample() {
    if (best_.shape.empty()) return;
    BoundedGain const gain = gain_at(best_.shape);
    best_.gain = gain.gain;
    best_.parameters = gain.parameters;
  }

  void search_in(Bounds const& box, ShapeSearch const& search, std::uint32_t run, int threads) {
    auto const optimiser = search.make(box, {search.seed, run, RandomDomain::optimiser});
    std::size_t const d = ranges_.size();
    for (int generation = 0; generation <= search.generations; ++generation) {
      std::size_t const members = optimiser->batch_size();
      std::vector<double> candidates(members * d), fitness(members);
      optimiser->ask({candidates.data(), members, d});
      std::vector<std::vector<double>> shapes(members, std::vector<double>(d));
      for (std::size_t i = 0; i < members; ++i)
        for (std::size_t k = 0; k < d; ++k) shapes[i][k] = from_unit(ranges_[k], candidates[i * d + k]);
      std::vector<BoundedGain> gains(members);
      for_shapes_together(members, threads, [&](std::size_t first, std::size_t last) {
        auto const at = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
        auto const groups =
            columns_.group_of_each(effect_, {shapes.begin() + at(first), shapes.begin() + at(last)}, LawRate::scan);
        for (std::size_t i = first; i < last; ++i) gains[i] = gain_of(groups[i - first]);
      });
      for (std::size_t i = 0; i < members; ++i) {
        fitness[i] = -gains[i].gain;
        keep(shapes[i], gains[i]);
      }
      optimiser->tell({candidates.data(), members, d}, fitness);
    }
  }

  void polish() {
    double damping = 1e-3;
    constexpr int most_steps = 8;
    for (int step = 0; step < most_steps && damping < 1e3; ++step) {
      double const before = best_.gain;
      std::vector<double> const next = stepped(damping);
      try_shape(next);
      if (best_.gain > before) {
        damping *= 0.1;
        if (best_.gain - before < 1e-6 * before) return;
      } else {
        damping *= 10.0;
      }
    }
  }

 private:
  BoundedGain gain_at(std::vector<double> const& shape) const { return gain_of(columns_.group(effect_, shape)); }

  BoundedGain gain_of(OrthonormalGroup const& group) const {
    return boxed_gain(group, inner_products(group.q, mismatch_), least_, most_);
  }

  double noise_at(std::vector<double> const& shape) const {
    auto const& rows = columns_.comparison().rows;
    auto const m = static_cast<double>(rows.n_twins());
    OrthonormalGroup const group = columns_.group(effect_, shape);
    Eigen::MatrixXd const apart = group.q.transpose() * (rows.twins.colwise() - rows.twin_mean);
    return apart.squaredNorm() / (m - 1.0) * (1.0 + 1.0 / m);
  }

  void keep(std::vector<double> const& shape, BoundedGain const& gain) {
    ++best_.evaluations;
    if (best_.evaluations > 1 && gain.gain <= best_.gain) return;
    if (only_plausible_ && !effect_.is_plausible(shape, columns_.scales())) return;
    best_.shape = shape;
    best_.gain = gain.gain;
    best_.improvements.push_back({best_.evaluations, gain.gain});
    best_.parameters = gain.parameters;
  }

  void try_shape(std::vector<double> const& shape) { keep(shape, gain_at(shape)); }

  Eigen::VectorXd without_nuisance(Eigen::VectorXd signal) const {
    signal -= columns_.nuisance() * (columns_.nuisance().transpose() * signal).eval();
    return signal;
  }

  // one damped step of all parameters together, in the unit scale of the shapes
  std::vector<double> stepped(double damping) {
    std::size_t const d = ranges_.size();
    Eigen::Index const linear = best_.parameters.size();
    std::vector<std::vector<double>> shapes{best_.shape};
    std::vector<double> steps;
    for (std::size_t k = 0; k < d; ++k) {
      double const unit = to_unit(ranges_[k], best_.shape[k]);
      steps.push_back(unit < 0.999 ? 1e-3 : -1e-3);
      shapes.push_back(best_.shape);
      shapes.back()[k] = from_unit(ranges_[k], unit + steps.back());
    }
    std::vector<Eigen::MatrixXd> const each = columns_.columns_of_each(effect_, shapes);
    Eigen::MatrixXd const& here = each.front();
    Eigen::MatrixXd jacobian(mismatch_.size(), linear + static_cast<Eigen::Index>(d));
    for (Eigen::Index k = 0; k < linear; ++k) jacobian.col(k) = without_nuisance(here.col(k));
    for (std::size_t k = 0; k < d; ++k) {
      Eigen::VectorXd const there = each[k + 1] * best_.parameters;
      jacobian.col(linear + static_cast<Eigen::Index>(k)) =
          without_nuisance((there - here * best_.parameters) / steps[k]);
      ++best_.evaluations;
    }
    Eigen::VectorXd const left = without_nuisance(mismatch_) - jacobian.leftCols(linear) * best_.parameters;
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    normal.diagonal() *= 1.0 + damping;
    Eigen::VectorXd const move = solve_semidefinite(normal, Eigen::VectorXd(jacobian.transpose() * left));
    std::vector<double> next = best_.shape;
    for (std::size_t k = 0; k < d; ++k) {
      double const unit = to_unit(ranges_[k], best_.shape[k]);
      double const moved = unit + move[linear + static_cast<Eigen::Index>(k)];
      if (std::isfinite(moved)) next[k] = from_unit(ranges_[k], moved);
    }
    return next;
  }

  CandidateColumns const& columns_;
  Effect const& effect_;
  std::vector<ParameterRange> const& ranges_;
  Eigen::VectorXd const& mismatch_;
  bool only_plausible_ = false;
  Eigen::VectorXd least_{}, most_{};  // plausible sizes of the linear parameters
  RefinedEffect best_{};
};

RefinedEffect refined_from(Refinement refinement, EffectScan const& scan, std::size_t point, ShapeSearch const& search,
                           int threads) {
  if (std::size_t const n = scan.effect->n_shape(); n > 0) {
    Bounds const whole{std::vector<double>(n, 0.0), std::vector<double>(n, 1.0)};
    if (search.everywhere) refinement.forget_start();
    refinement.search_in(search.everywhere ? whole : scan.grid.box(point), search, static_cast<std::uint32_t>(point),
                         threads);
    refinement.see_every_sample();
    refinement.polish();
  }
  return std::move(refinement).take();
}

}  // namespace

ShapeSearch shape_search(std::string const& optimiser, std::uint64_t seed, std::int64_t members) {
  auto const* choice = find_optimiser(optimiser);
  TORQUESCOPE_EXPECT(choice != nullptr);
  Section section;
  section.settings.push_back({"population", OptionValue{members}});
  std::vector<Problem> problems;
  ShapeSearch search;
  search.make = choice->prepare(section, {}, problems);
  search.seed = seed;
  TORQUESCOPE_EXPECT(problems.empty());
  return search;
}

std::optional<std::size_t> best_plausible_point(CandidateColumns const& columns, EffectScan const& scan,
                                                Eigen::VectorXd const& mismatch, int threads) {
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < scan.grid.size(); ++k)
    if (scan.effect->is_plausible(scan.grid.point(k), columns.scales())) points.push_back(k);
  std::vector<double> gains(scan.grid.size(), 0.0);
  for_shapes_together(points.size(), threads, [&](std::size_t first, std::size_t last) {
    std::vector<std::vector<double>> shapes;
    for (std::size_t i = first; i < last; ++i) shapes.push_back(scan.grid.point(points[i]));
    auto const groups = columns.group_of_each(*scan.effect, shapes, LawRate::scan);
    for (std::size_t i = first; i < last; ++i) {
      auto const& group = groups[i - first];
      gains[points[i]] = bounded_gain(group, inner_products(group.q, mismatch)).gain;
    }
  });
  auto const most = std::max_element(gains.begin(), gains.end());
  if (most == gains.end() || *most <= 0.0) return std::nullopt;
  return static_cast<std::size_t>(most - gains.begin());
}

RefinedEffect refine_plausible_from(CandidateColumns const& columns, EffectScan const& scan, std::size_t point,
                                    Eigen::VectorXd const& mismatch, ShapeSearch const& search, int threads) {
  return refined_from({columns, scan, point, mismatch, true}, scan, point, search, threads);
}

std::optional<RefinedEffect> refine_plausible(CandidateColumns const& columns, EffectScan const& scan,
                                              Eigen::VectorXd const& mismatch, ShapeSearch const& search, int threads) {
  auto const point = best_plausible_point(columns, scan, mismatch, threads);
  if (!point) return std::nullopt;
  return refine_plausible_from(columns, scan, *point, mismatch, search, threads);
}

RefinedEffect refine_shape(CandidateColumns const& columns, EffectScan const& scan, Eigen::VectorXd const& mismatch,
                           ShapeSearch const& search, int threads) {
  RefinedEffect best = refined_from({columns, scan, scan.best_point, mismatch}, scan, scan.best_point, search, threads);
  if (scan.effect->is_plausible(best.shape, columns.scales())) return best;
  auto plausible = refine_plausible(columns, scan, mismatch, search, threads);
  if (!plausible || plausible->gain < nearly_as_good * best.gain) return best;
  plausible->evaluations += best.evaluations;
  return std::move(*plausible);
}

}  // namespace torquescope
