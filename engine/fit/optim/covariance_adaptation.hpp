#pragma once
// The normal distribution of CMA-ES: where it samples, and what it learns from the order of its samples.
//
// Equation   x = m + sigma B D z,  C = B D^2 B^T;  m moves to the weighted mean of the better half; sigma follows the
//            length of the path p_sigma (cumulative step size adaptation), C the path p_c (rank one) and the better
//            half (rank mu). Of the worse half, who is told of may take variance away along its steps (active)
// Order      only the order of fitness counts, so nothing changes when fitness goes through an increasing function.
//            Samples without finite fitness have no place in the order: with fewer than mu others, these share the
//            weight; with none, nothing is learned
// Shapes     R parameters, in units of the search box (0 .. 1, but unbounded here); one sample per column
// Limits     no standard deviation grows beyond the box; collapsed() when one is below 1e-12 of it, or when the axes of
//            C differ by 1e14 in variance: rounding would decide from there on
// Threads    a value; const calls allocate
// Source     Hansen: The CMA evolution strategy: a tutorial, arXiv 1604.00772 (2016), appendix A and table 1; the
//            rank-mu rate is that of its first version

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace torquescope {

class CovarianceAdaptation {
 public:
  // n_samples >= 4
  CovarianceAdaptation(Eigen::VectorXd mean, double sigma, std::size_t n_samples);

  // z: R standard normal numbers
  Eigen::VectorXd sample(Eigen::VectorXd const& z) const;
  // the z of which sample() would be this
  Eigen::VectorXd deviates_of(Eigen::VectorXd const& place) const;
  // the z of this generation's finite samples, best first: mu of them are read. `worse_z` of those that are to take
  // variance away, the worst last
  void learn(Eigen::MatrixXd const& ranked_z, Eigen::MatrixXd const& worse_z = {});

  bool is_collapsed() const;
  Eigen::VectorXd const& mean() const { return mean_; }
  double sigma() const { return sigma_; }
  Eigen::MatrixXd const& covariance() const { return covariance_; }  // without sigma^2

  // mean, sigma, updates, both paths, C by columns: everything else follows
  std::vector<double> numbers() const;
  static std::size_t numbers_of(std::size_t dimension) { return dimension * (3 + dimension) + 2; }
  void restore(std::span<double const> numbers);

 private:
  void decompose();
  Eigen::VectorXd weights_against(std::size_t n_samples) const;

  // of the number of samples and parameters alone
  Eigen::VectorXd weights_;        // mu of them, sum 1
  Eigen::VectorXd worse_weights_;  // of the others, at most 0
  double c_sigma_, d_sigma_, c_c_, c_1_, c_mu_, usual_length_;

  Eigen::VectorXd mean_;
  double sigma_;
  std::int64_t updates_ = 0;
  Eigen::VectorXd path_sigma_, path_c_;
  Eigen::MatrixXd covariance_;

  // of the covariance
  Eigen::MatrixXd axes_;     // B
  Eigen::VectorXd lengths_;  // D
};

}  // namespace torquescope
