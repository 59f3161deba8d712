#include "engine/infer/decision/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/simulate/rollout/effective_samples.hpp"

namespace torquescope {

Score::Score(Eigen::MatrixXd const& base, Eigen::MatrixXd signals, Eigen::Index guard, FoldKind kind)
    : basis_(orthonormal_basis(base)), signals_(std::move(signals)), folds_(folds(basis_.rows(), guard, kind)) {
  Eigen::MatrixXd both(basis_.rows(), basis_.cols() + signals_.cols());
  both << basis_, signals_;
  beside_ = folded_rows(folds_, both);
  auto const all = fold_products(folded_rows(folds_, basis_), beside_);
  gram_ = picked(all, 0, basis_.cols(), 0, basis_.cols());
  products_ = picked(all, 0, basis_.cols(), basis_.cols(), signals_.cols());
  own_ = fold_energies(folds_, signals_).colwise().sum().transpose();
  left_ = own_ + left_inside_less_own(gram_, products_).colwise().sum().transpose();
}

bool Score::has_wrong_sign(OrthonormalGroup const& group, Eigen::Index signal) const {
  if (std::find(group.non_negative.begin(), group.non_negative.end(), true) == group.non_negative.end()) return false;
  return !(bounded_gain(group, group.q.transpose() * signals_.col(signal)).gain > 0.0);
}

Score::Products Score::products_with(OrthonormalGroup const& group) const {
  FoldedRows const own = folded_rows(folds_, group.q);
  FoldProducts const beside = fold_products(own, beside_);
  return {gram_of(gram_, picked(beside, 0, group.rank(), 0, basis_.cols()), fold_products(own, own)),
          stacked(products_, picked(beside, 0, group.rank(), basis_.cols(), signals_.cols()))};
}

Eigen::VectorXd Score::left_with(OrthonormalGroup const& group) const {
  if (group.rank() == 0) return left_;
  Products const with = products_with(group);
  Eigen::VectorXd left = own_ + left_inside_less_own(with.gram, with.signals).colwise().sum().transpose();
  for (Eigen::Index k = 0; k < left.size(); ++k)
    if (has_wrong_sign(group, k)) left[k] = left_[k];
  return left;
}

Eigen::VectorXd Score::left_on_rows_with(OrthonormalGroup const& group, Eigen::Index signal) const {
  Eigen::VectorXd const one = signals_.col(signal);
  if (group.rank() == 0)
    return left_on_rows(folds_, basis_, one, gram_, picked(products_, 0, basis_.cols(), signal, 1));
  Eigen::MatrixXd all(basis_.rows(), basis_.cols() + group.rank());
  all << basis_, group.q;
  Products const with = products_with(group);
  return left_on_rows(folds_, all, one, with.gram, picked(with.signals, 0, all.cols(), signal, 1));
}

double Score::gain(OrthonormalGroup const& group, Eigen::Index signal) const {
  if (group.rank() == 0 || has_wrong_sign(group, signal)) return 0.0;
  Eigen::VectorXd const rows = left_on_rows_with(group, signal);
  double const with = rows.squaredNorm(), without = left_[signal];
  if (!(with > 0.0) || !(with < without)) return 0.0;
  return effective_samples(rows) * std::log(without / with);
}

}  // namespace torquescope
