#include "engine/infer/all_rows/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/simulate/rollout/effective_samples.hpp"

namespace torquescope {

Score::Score(Eigen::MatrixXd const& base, Eigen::MatrixXd signals, Eigen::Index guard)
    : basis_(orthonormal_basis(base)), signals_(std::move(signals)) {
  whole_ = folded(guard, FoldKind::whole);
  interleaved_ = folded(guard, FoldKind::interleaved);
}

Score::Folded Score::folded(Eigen::Index guard, FoldKind kind) const {
  Folded result;
  result.folds = folds(basis_.rows(), guard, kind);
  result.gram = fold_products(result.folds, basis_, basis_);
  result.products = fold_products(result.folds, basis_, signals_);
  result.own = fold_energies(result.folds, signals_).colwise().sum().transpose();
  result.left = result.own + left_inside_less_own(result.gram, result.products).colwise().sum().transpose();
  return result;
}

bool Score::has_wrong_sign(OrthonormalGroup const& group, Eigen::Index signal) const {
  if (std::find(group.non_negative.begin(), group.non_negative.end(), true) == group.non_negative.end()) return false;
  return !(bounded_gain(group, group.q.transpose() * signals_.col(signal)).gain > 0.0);
}

Eigen::VectorXd Score::left_with(OrthonormalGroup const& group, FoldKind kind) const {
  Folded const& folded = of(kind);
  if (group.rank() == 0) return folded.left;
  FoldProducts const cross = fold_products(folded.folds, group.q, basis_);
  FoldProducts const gram = gram_of(folded.gram, cross, fold_products(folded.folds, group.q, group.q));
  FoldProducts const products = stacked(folded.products, fold_products(folded.folds, group.q, signals_));
  Eigen::VectorXd left = folded.own + left_inside_less_own(gram, products).colwise().sum().transpose();
  for (Eigen::Index k = 0; k < left.size(); ++k)
    if (has_wrong_sign(group, k)) left[k] = folded.left[k];
  return left;
}

Eigen::VectorXd Score::left_on_rows_with(OrthonormalGroup const& group, Eigen::Index signal, FoldKind kind) const {
  Folded const& folded = of(kind);
  Eigen::VectorXd const one = signals_.col(signal);
  FoldProducts const own = picked(folded.products, 0, basis_.cols(), signal, 1);
  if (group.rank() == 0) return left_on_rows(folded.folds, basis_, one, folded.gram, own);
  Eigen::MatrixXd all(basis_.rows(), basis_.cols() + group.rank());
  all << basis_, group.q;
  FoldProducts const cross = fold_products(folded.folds, group.q, basis_);
  return left_on_rows(folded.folds, all, one,
                      gram_of(folded.gram, cross, fold_products(folded.folds, group.q, group.q)),
                      stacked(own, fold_products(folded.folds, group.q, one)));
}

double Score::gain(OrthonormalGroup const& group, Eigen::Index signal, FoldKind kind) const {
  if (group.rank() == 0 || has_wrong_sign(group, signal)) return 0.0;
  Eigen::VectorXd const rows = left_on_rows_with(group, signal, kind);
  double const with = rows.squaredNorm(), without = of(kind).left[signal];
  if (!(with > 0.0) || !(with < without)) return 0.0;
  return effective_samples(rows) * std::log(without / with);
}

}  // namespace torquescope
