#include "engine/robot/consistency.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"
#include "engine/robot/pseudo_inertia.hpp"

namespace torquescope {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double barrier_cut = 0.5;       // weight of the next barrier over that of this one
constexpr double centred = 1e-3;          // squared Newton decrement that is near enough to the path
constexpr double centred_at_end = 1e-20;  // the same at the path's end: rounding
// ten are enough where a least distance exists. Where it does not, because the closer bodies are the heavier ones
// without end (the mass of a link that only turns has no effect), the path becomes endless too
constexpr int most_steps_a_weight = 60;

// values of an estimate = matrix * (standard parameters, those beside the arm)
MatrixXd sums_of(BaseParameters const& base, Index n_beside) {
  Index const p = base.size(), n = base.standard_size();
  MatrixXd sums = MatrixXd::Zero(p + n_beside, n + n_beside);
  for (Index k = 0; k < n; ++k) sums.col(k).head(p) = base.from_standard(VectorXd::Unit(n, k));
  sums.bottomRightCorner(n_beside, n_beside).setIdentity();
  return sums;
}

// the k-th of ten symmetric matrices of length 1, orthogonal to each other
PseudoInertia symmetric_unit(Index k) {
  constexpr Index rows[] = {0, 1, 2, 3, 0, 0, 0, 1, 1, 2}, columns[] = {0, 1, 2, 3, 1, 2, 3, 2, 3, 3};
  PseudoInertia unit = PseudoInertia::Zero();
  unit(rows[k], columns[k]) = unit(columns[k], rows[k]) = rows[k] == columns[k] ? 1.0 : std::sqrt(0.5);
  return unit;
}

// what a link or a drive without a prior is measured with
struct Cube {
  double length = 0.0, mass = 1.0;

  Cube(SerialChain const& chain, BaseParameters const& base, VectorXd const& values) {
    for (auto const& joint : chain.joints) length = std::max({length, std::abs(joint.a), std::abs(joint.d)});
    if (length == 0.0) length = 1.0;
    double largest = 0.0;  // of the values, each as a mass
    for (Index k = 0; k < base.size(); ++k) {
      auto const& unit = base.parameters()[static_cast<std::size_t>(k)].unit;
      double const per_kg = unit == "kg" ? 1.0 : unit == "kg m" ? length : length * length;
      largest = std::max(largest, std::abs(values[k]) / per_kg);
    }
    if (largest > 0.0) mass = largest;
  }
  double second_moment() const { return mass * length * length / 12.0; }
  PseudoInertia pseudo() const {
    return Eigen::Vector4d(second_moment(), second_moment(), second_moment(), mass).asDiagonal();
  }
};

// links by their Cholesky factors; drives and what is beside the arm: positive whatever the rounding
struct Bodies {
  std::vector<PseudoInertia> factors;
  VectorXd scalars;
};

// what a parameter beside the arm is measured with: itself, or its standard error where that is more
VectorXd scales_beside(BaseEstimate const& estimate, Index p) {
  VectorXd const lengths = estimate.root.colwise().norm().transpose();
  VectorXd const errors = lengths.cwiseMax(std::numeric_limits<double>::min()).cwiseInverse();
  Index const n = estimate.values.size() - p;
  return estimate.values.tail(n).cwiseMax(errors.tail(n));
}

// A step is a symmetric matrix S for each link, L (1 + S) L', and a share of each scalar: the barrier's second
// derivative by them is 1.
class ClosestBodies {
 public:
  ClosestBodies(SerialChain const& chain, BaseParameters const& base, BaseEstimate const& estimate,
                InertiaPrior const& prior)
      : whitened_(estimate.root * sums_of(base, estimate.values.size() - base.size())),
        target_(estimate.root * estimate.values),
        n_scalars_(whitened_.cols() - numbers_per_link * chain.size()) {
    TORQUESCOPE_EXPECT(prior.links.empty() || prior.links.size() == chain.joints.size());
    TORQUESCOPE_EXPECT(prior.drives.empty() || prior.drives.size() == chain.joints.size());
    Cube const cube(chain, base, estimate.values);
    for (std::size_t i = 0; i < chain.joints.size(); ++i) {
      bool const is_known = !prior.links.empty() && prior.links[i].mass > 0.0;
      priors_.push_back(is_known ? pseudo_inertia(prior.links[i].vector()) : cube.pseudo());
      prior_inverses_.push_back(inverse(priors_.back()));
      bodies_.factors.push_back(cholesky_factor(priors_.back()));
    }
    Index const n_drives = base.standard_size() - numbers_per_link * chain.size();
    scales_ = VectorXd(n_scalars_);
    for (Index i = 0; i < n_drives; ++i) {
      auto const at = static_cast<std::size_t>(i);
      double const own = prior.drives.empty() ? 0.0 : prior.drives[at];
      bool const turns = chain.joints[at].kind == JointKind::revolute;
      scales_[i] = own > 0.0 ? own : turns ? cube.second_moment() : cube.mass;
    }
    scales_.tail(n_scalars_ - n_drives) = scales_beside(estimate, base.size());
    bodies_.scalars = scales_;
  }

  ConsistentParameters solve(BaseParameters const& base, double end_weight) {
    ConsistentParameters result;
    auto const gap = [&](double weight) { return 2.0 * std::max(0.0, weight - end_weight) * gap_per_weight(); };
    double weight = std::max({1.0, residual().squaredNorm() / gap_per_weight(), end_weight});
    Bodies nearest = bodies_;
    result.gap = std::numeric_limits<double>::infinity();
    for (bool is_last = false; !is_last; weight = std::max(end_weight, barrier_cut * weight)) {
      is_last = weight <= end_weight || gap(weight) <= largest_gap;
      if (!centre(weight, is_last ? centred_at_end : centred, result.steps)) break;
      nearest = bodies_;
      result.gap = gap(weight);
    }
    bodies_ = nearest;
    result.converged = result.gap <= visible_gap;
    VectorXd const all = unknowns();
    result.standard = all.head(base.standard_size());
    result.beside = all.tail(all.size() - base.standard_size());
    result.base = base.from_standard(result.standard);
    result.distance = residual().norm();
    result.divergence = divergences();
    return result;
  }

 private:
  Index n_links() const { return static_cast<Index>(bodies_.factors.size()); }
  PseudoInertia link(std::size_t i) const { return bodies_.factors[i] * bodies_.factors[i].transpose(); }

  VectorXd unknowns() const {
    VectorXd all(numbers_per_link * n_links() + n_scalars_);
    for (Index i = 0; i < n_links(); ++i)
      all.segment<numbers_per_link>(numbers_per_link * i) = link_vector(link(static_cast<std::size_t>(i)));
    all.tail(n_scalars_) = bodies_.scalars;
    return all;
  }

  VectorXd residual() const { return whitened_ * unknowns() - target_; }

  double divergences() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies_.factors.size(); ++i) sum += divergence(link(i), priors_[i]);
    for (Index i = 0; i < n_scalars_; ++i)
      sum += std::log(scales_[i] / bodies_.scalars[i]) + bodies_.scalars[i] / scales_[i] - 1.0;
    return sum;
  }

  // half the squared distance is above its least by at most the weight times this (weak duality, at a point of the
  // path; the closest bodies taken as large as these)
  double gap_per_weight() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies_.factors.size(); ++i)
      sum += 4.0 + prior_inverses_[i].cwiseProduct(link(i)).sum();
    return sum + static_cast<double>(n_scalars_) + bodies_.scalars.cwiseQuotient(scales_).sum();
  }

  // residual and slope of the divergences by the coordinates of a step
  struct Slopes {
    MatrixXd residual;
    VectorXd divergence;
  };
  Slopes slopes() const {
    Index const n = numbers_per_link * n_links() + n_scalars_;
    Slopes at{MatrixXd(whitened_.rows(), n), VectorXd(n)};
    for (Index i = 0; i < n_links(); ++i) {
      auto const& factor = bodies_.factors[static_cast<std::size_t>(i)];
      PseudoInertia const pull =
          factor.transpose() * prior_inverses_[static_cast<std::size_t>(i)] * factor - PseudoInertia::Identity();
      for (Index k = 0; k < numbers_per_link; ++k) {
        Index const column = numbers_per_link * i + k;
        PseudoInertia const unit = symmetric_unit(k);
        at.residual.col(column) = whitened_.middleCols(numbers_per_link * i, numbers_per_link) *
                                  link_vector(factor * unit * factor.transpose());
        at.divergence[column] = pull.cwiseProduct(unit).sum();
      }
    }
    at.residual.rightCols(n_scalars_) = whitened_.rightCols(n_scalars_) * bodies_.scalars.asDiagonal();
    at.divergence.tail(n_scalars_) = bodies_.scalars.cwiseQuotient(scales_).array() - 1.0;
    return at;
  }

  // a Newton step of distance^2 / (2 weight) + divergences is a least-squares problem: nothing is squared
  VectorXd newton_step(Slopes const& at, double weight) const {
    Index const p = at.residual.rows(), n = at.residual.cols();
    double const root = std::sqrt(weight);
    MatrixXd rows(p + n, n);
    rows << at.residual, root * MatrixXd::Identity(n, n);
    VectorXd right(p + n);
    right << -residual(), -root * at.divergence;
    return solve_pivoted(rows, right);
  }

  // Steps at one weight until the squared decrement is below `least`, or rounding alone is left of it. The cost is
  // self-concordant: these step lengths stay inside and need no search (Boyd and Vandenberghe, section 9.6)
  bool centre(double weight, double least, int& steps) {
    double before = std::numeric_limits<double>::infinity();
    for (int step_here = 0; step_here < most_steps_a_weight; ++step_here, ++steps) {
      auto const at = slopes();
      VectorXd const step = newton_step(at, weight);
      double const decrement = step.squaredNorm() + (at.residual * step).squaredNorm() / weight;
      bool const is_near = decrement < 0.0625;
      if (decrement <= least || (is_near && decrement > 0.5 * before)) return true;
      advance(is_near ? step : VectorXd(step / (1.0 + std::sqrt(decrement))));
      before = decrement;
    }
    return false;
  }

  void advance(VectorXd const& step) {
    for (Index i = 0; i < n_links(); ++i) {
      PseudoInertia inner = PseudoInertia::Identity();
      for (Index k = 0; k < numbers_per_link; ++k) inner += step[numbers_per_link * i + k] * symmetric_unit(k);
      auto& factor = bodies_.factors[static_cast<std::size_t>(i)];
      factor = factor * cholesky_factor(inner);
    }
    bodies_.scalars = bodies_.scalars.cwiseProduct((1.0 + step.tail(n_scalars_).array()).matrix());
  }

  MatrixXd whitened_;  // residual = whitened * unknowns - target, in standard errors
  VectorXd target_;
  Index n_scalars_;
  std::vector<PseudoInertia> priors_, prior_inverses_;
  VectorXd scales_;
  Bodies bodies_;
};

}  // namespace

ConsistentParameters consistent_parameters(SerialChain const& chain, BaseParameters const& base,
                                           BaseEstimate const& estimate, InertiaPrior const& prior) {
  TORQUESCOPE_EXPECT(estimate.values.size() >= base.size());
  TORQUESCOPE_EXPECT(estimate.root.cols() == estimate.values.size());
  return ClosestBodies(chain, base, estimate, prior).solve(base, prior.weight);
}

std::string prior_fault(LinkInertia const& link) {
  constexpr double rounding = 1e-12;
  std::string fault = body_fault(link);
  if (!fault.empty()) return fault;
  VectorXd const sizes = symmetric_eigenvalues(pseudo_inertia(link.vector()));
  return sizes.minCoeff() > rounding * sizes.maxCoeff() ? "" : "it has no thickness";
}

}  // namespace torquescope
