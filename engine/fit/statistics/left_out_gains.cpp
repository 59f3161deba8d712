#include "engine/fit/statistics/left_out_gains.hpp"

#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"

namespace torquescope {
namespace {

// of the rows that a fit without them still sees
Eigen::MatrixXd seen_gram(Eigen::MatrixXd const& left_out) {
  return (1.0 + left_out_ridge) * Eigen::MatrixXd::Identity(left_out.rows(), left_out.cols()) - left_out;
}

}  // namespace

LeftOutGains::LeftOutGains(FoldProducts const& gram, FoldProducts const& products) {
  for (std::size_t f = 0; f < gram.inside.size(); ++f) {
    Eigen::Index const k = gram.whole.rows();
    Fit one{solve_positive(seen_gram(gram.left_out[f]), Eigen::MatrixXd(Eigen::MatrixXd::Identity(k, k))),
            gram.inside[f],
            {},
            {}};
    one.fit = one.inverse * (products.whole - products.left_out[f]);
    one.left = products.inside[f] - gram.inside[f] * one.fit;
    folds_.push_back(std::move(one));
  }
}

std::vector<LeftOutGains::Beside> LeftOutGains::beside(std::size_t f, FoldProducts const& all,
                                                       std::span<FoldProducts const> own) const {
  Fit const& basis = folds_[f];
  Eigen::Index const k = basis.inverse.rows(), m = all.whole.cols() - k;
  auto const outside = all.left_out[f].leftCols(k), inside = all.inside[f].leftCols(k);  // R x k
  Eigen::MatrixXd const u = basis.inverse * outside.transpose();                         // k x R
  Eigen::MatrixXd const seen = all.whole.rightCols(m) - all.left_out[f].rightCols(m) + outside * basis.fit;
  Eigen::MatrixXd const left = all.inside[f].rightCols(m) - inside * basis.fit + u.transpose() * basis.left;
  Eigen::MatrixXd const gram_u = basis.gram_inside * u;
  std::vector<Beside> each;
  Eigen::Index at = 0;
  for (FoldProducts const& one : own) {
    Eigen::Index const r = one.whole.rows();
    if (r == 0) {
      each.push_back({Eigen::MatrixXd(0, m), Eigen::MatrixXd(0, m), Eigen::MatrixXd(0, 0)});
      continue;
    }
    auto const own_u = u.middleCols(at, r);
    Eigen::MatrixXd const schur = seen_gram(one.left_out[f]) - outside.middleRows(at, r) * own_u;
    Eigen::MatrixXd const crossed = inside.middleRows(at, r) * own_u;
    each.push_back({solve_positive(schur, Eigen::MatrixXd(seen.middleRows(at, r))), left.middleRows(at, r),
                    one.inside[f] + crossed + crossed.transpose() + own_u.transpose() * gram_u.middleCols(at, r)});
    at += r;
  }
  return each;
}

std::vector<Eigen::MatrixXd> LeftOutGains::of_each(FoldProducts const& all, std::span<FoldProducts const> own) const {
  TORQUESCOPE_EXPECT(all.inside.size() == folds_.size());
  Eigen::Index const m = folds_.empty() ? 0 : folds_.front().fit.cols();
  std::vector<Eigen::MatrixXd> gains(own.size(), Eigen::MatrixXd(static_cast<Eigen::Index>(folds_.size()), m));
  for (std::size_t f = 0; f < folds_.size(); ++f) {
    auto const effects = beside(f, all, own);
    for (std::size_t i = 0; i < own.size(); ++i)
      gains[i].row(static_cast<Eigen::Index>(f)) =
          (effects[i].fit.array() * (2.0 * effects[i].left - effects[i].square * effects[i].fit).array())
              .colwise()
              .sum();
  }
  return gains;
}

Eigen::MatrixXd LeftOutGains::of(FoldProducts const& cross, FoldProducts const& own,
                                 FoldProducts const& products) const {
  return of_each(side_by_side(cross, products), {&own, 1}).front();
}

Eigen::MatrixXd LeftOutGains::form(FoldProducts const& cross, FoldProducts const& own,
                                   FoldProducts const& products) const {
  FoldProducts const all = side_by_side(cross, products);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(products.whole.cols(), products.whole.cols());
  for (std::size_t f = 0; f < folds_.size(); ++f) {
    Beside const effect = beside(f, all, {&own, 1}).front();
    sum += effect.fit.transpose() * (2.0 * effect.left - effect.square * effect.fit);
  }
  return sum;
}

}  // namespace torquescope
