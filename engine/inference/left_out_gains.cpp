#include "engine/inference/left_out_gains.hpp"

#include <Eigen/Cholesky>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/inference/decision_levels.hpp"

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
    Fit one{seen_gram(gram.left_out[f]).llt().solve(Eigen::MatrixXd::Identity(k, k)), gram.inside[f], {}, {}};
    one.fit = one.inverse * (products.whole - products.left_out[f]);
    one.left = products.inside[f] - gram.inside[f] * one.fit;
    folds_.push_back(std::move(one));
  }
}

LeftOutGains::Beside LeftOutGains::beside(std::size_t f, FoldProducts const& cross, FoldProducts const& own,
                                          FoldProducts const& products) const {
  Fit const& basis = folds_[f];
  Eigen::MatrixXd const &outside = cross.left_out[f], &inside = cross.inside[f];  // r x k
  Eigen::MatrixXd const u = basis.inverse * outside.transpose();                  // k x r
  Eigen::MatrixXd const schur = seen_gram(own.left_out[f]) - outside * u;
  Eigen::MatrixXd const crossed = inside * u;
  return {schur.llt().solve(products.whole - products.left_out[f] + outside * basis.fit),
          products.inside[f] - inside * basis.fit + u.transpose() * basis.left,
          own.inside[f] + crossed + crossed.transpose() + u.transpose() * basis.gram_inside * u};
}

Eigen::MatrixXd LeftOutGains::of(FoldProducts const& cross, FoldProducts const& own,
                                 FoldProducts const& products) const {
  TORQUESCOPE_EXPECT(cross.inside.size() == folds_.size() && own.inside.size() == folds_.size());
  Eigen::MatrixXd gains(static_cast<Eigen::Index>(folds_.size()), products.whole.cols());
  for (std::size_t f = 0; f < folds_.size(); ++f) {
    Beside const law = beside(f, cross, own, products);
    gains.row(static_cast<Eigen::Index>(f)) =
        (law.fit.array() * (2.0 * law.left - law.square * law.fit).array()).colwise().sum();
  }
  return gains;
}

Eigen::MatrixXd LeftOutGains::form(FoldProducts const& cross, FoldProducts const& own,
                                   FoldProducts const& products) const {
  TORQUESCOPE_EXPECT(cross.inside.size() == folds_.size() && own.inside.size() == folds_.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(products.whole.cols(), products.whole.cols());
  for (std::size_t f = 0; f < folds_.size(); ++f) {
    Beside const law = beside(f, cross, own, products);
    sum += law.fit.transpose() * (2.0 * law.left - law.square * law.fit);
  }
  return sum;
}

}  // namespace torquescope
