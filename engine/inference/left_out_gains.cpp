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

Eigen::MatrixXd LeftOutGains::of(FoldProducts const& cross, FoldProducts const& own,
                                 FoldProducts const& products) const {
  TORQUESCOPE_EXPECT(cross.inside.size() == folds_.size() && own.inside.size() == folds_.size());
  Eigen::MatrixXd gains(static_cast<Eigen::Index>(folds_.size()), products.whole.cols());
  for (std::size_t f = 0; f < folds_.size(); ++f) {
    Fit const& beside = folds_[f];
    Eigen::MatrixXd const &outside = cross.left_out[f], &inside = cross.inside[f];  // r x k
    Eigen::MatrixXd const u = beside.inverse * outside.transpose();                 // k x r
    Eigen::MatrixXd const schur = seen_gram(own.left_out[f]) - outside * u;
    Eigen::MatrixXd const c = schur.llt().solve(products.whole - products.left_out[f] + outside * beside.fit);
    Eigen::MatrixXd const with_left = products.inside[f] - inside * beside.fit + u.transpose() * beside.left;
    Eigen::MatrixXd const crossed = inside * u;
    Eigen::MatrixXd const square =
        own.inside[f] + crossed + crossed.transpose() + u.transpose() * beside.gram_inside * u;
    gains.row(static_cast<Eigen::Index>(f)) = (c.array() * (2.0 * with_left - square * c).array()).colwise().sum();
  }
  return gains;
}

}  // namespace torquescope
