#include "engine/simulate/feedforward_search.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/dense_solvers.hpp"
#include "engine/simulate/autoregression.hpp"

namespace torquescope {
namespace {

constexpr std::size_t most_terms = 6;
constexpr std::size_t most_rows = 4096;  // terms of a known signal: more rows would find the same ones
constexpr int widths = 20;

double fastest_slope(Eigen::VectorXd const& r) {
  return (r.tail(r.size() - 1) - r.head(r.size() - 1)).cwiseAbs().maxCoeff();
}

std::vector<ReferenceTerm> candidates(LoopSignals const& s) {
  std::vector<ReferenceTerm> all;
  for (auto shape : {ReferenceShape::sine, ReferenceShape::cosine}) all.push_back({shape, 0});
  double const fastest = fastest_slope(s.reference);
  for (int i = 0; i < widths; ++i) {
    double const width = fastest * std::exp2(-0.5 * i);
    for (int ahead = -1; ahead <= 2; ++ahead)
      for (int span = 1; span <= 4; ++span) all.push_back({ReferenceShape::smooth_sign, ahead, span, width});
  }
  return all;
}

// how much of what is left a term would take, given all that is in the controller already
class Projection {
 public:
  Projection(LoopSignals const& s, ControllerColumns const& columns, SampleRows const& rows)
      : reference_(s.reference), rows_(rows) {
    Eigen::MatrixXd const x = controller_regressors(s, columns, rows);
    Eigen::RowVectorXd const per_length = x.colwise().norm().cwiseMax(1e-300).cwiseInverse();
    basis_ = PivotedQr(x * per_length.asDiagonal(), 1e-12).basis();
    Eigen::VectorXd const u = picked(s.torque, rows);
    residual_ = u - basis_ * (basis_.transpose() * u);
  }

  Eigen::VectorXd const& residual() const { return residual_; }

  double gain(ReferenceTerm const& term) const {
    Eigen::VectorXd column(residual_.size());
    for (Eigen::Index i = 0; i < column.size(); ++i) column[i] = term(reference_, rows_[static_cast<std::size_t>(i)]);
    double const whole = column.squaredNorm();
    column -= basis_ * (basis_.transpose() * column);
    double const own = column.squaredNorm();
    constexpr double rounding = 1e-18;  // a column that the controller has already
    if (own <= rounding * whole) return 0.0;
    double const along = column.dot(residual_);
    return along * along / own;
  }

 private:
  ReferenceSignal reference_;
  SampleRows const& rows_;
  Eigen::MatrixXd basis_;
  Eigen::VectorXd residual_;
};

ReferenceTerm refined(ReferenceTerm term, Projection const& projection) {
  double best = projection.gain(term);
  for (double factor : {1.19, 1.09, 1.044, 1.022, 1.011})
    for (double width : {term.width * factor, term.width / factor}) {
      ReferenceTerm tried = term;
      tried.width = width;
      if (double const gain = projection.gain(tried); gain > best) {
        best = gain;
        term = tried;
      }
    }
  return term;
}

bool is_worth_a_term(double gain, Projection const& projection, std::size_t tried, bool is_first) {
  constexpr double z = 3.29;
  Eigen::VectorXd const& residual = projection.residual();
  double const memory = std::clamp(autocorrelation(residual, 1), 0.0, 0.99);
  double const independent = static_cast<double>(residual.size()) * (1.0 - memory) / (1.0 + memory);
  double const left = std::max(residual.squaredNorm() - gain, 1e-300);
  double const least_share = is_first ? 0.1 : 0.0;
  return gain > least_share * residual.squaredNorm() &&
         independent * gain / left > z * z + 2.0 * std::log(static_cast<double>(tried));
}

}  // namespace

std::vector<ReferenceTerm> find_feedforward(LoopSignals const& s, ControllerColumns columns, SampleRows const& rows) {
  SampleRows const some = thinned(rows, most_rows);
  std::vector<ReferenceTerm> const all = candidates(s);
  while (columns.terms.size() < most_terms) {
    Projection const projection(s, columns, some);
    ReferenceTerm const* best = nullptr;
    double most = 0.0;
    for (auto const& term : all)
      if (double const gain = projection.gain(term); gain > most) {
        most = gain;
        best = &term;
      }
    if (best == nullptr || !is_worth_a_term(most, projection, all.size(), columns.terms.empty())) break;
    columns.terms.push_back(best->shape == ReferenceShape::smooth_sign ? refined(*best, projection) : *best);
  }
  return columns.terms;
}

}  // namespace torquescope
