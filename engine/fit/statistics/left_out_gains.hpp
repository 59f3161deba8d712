#pragma once
// What further columns take off the rows left out, beside a basis that stays: one factorisation for all candidates.
//
// Equation   of a fold with rows F inside and G left out (left_out.hpp): A = (1 + r) I - N_G' N_G, b the fit of the
//            basis N alone. With the candidate's columns Q, orthonormal and orthogonal to N:
//            u = A^-1 N_G' Q,  S = (1 + r) I - Q_G' Q_G - Q_G' N_G u,  c = S^-1 (Q' y - Q_G' y_G + Q_G' N_G b),
//            and with W = Q_F + N_F u the fall of the energy inside is 2 c' W' (y_F - N_F b) - c' W' W c
// Shapes     k columns of the basis, r of the candidate, m signals, folds as in the products
// Threads    const object
// Source     Schur complement of the normal equations: Golub, Van Loan 2013, Matrix Computations, 3.2

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/fit/statistics/left_out.hpp"

namespace torquescope {

class LeftOutGains {
 public:
  LeftOutGains() = default;
  // gram: of the basis with itself (k x k); products: of the basis with the signals (k x m)
  LeftOutGains(FoldProducts const& gram, FoldProducts const& products);

  // cross: of the candidate with the basis (r x k), own: with itself (r x r), products: with the signals (r x m).
  // Returns folds x m
  Eigen::MatrixXd of(FoldProducts const& cross, FoldProducts const& own, FoldProducts const& products) const;
  // The same of several candidates, whose columns lie side by side: `all`: of these with basis and signals (R x (k +
  // m)), own: of each with itself. The signals are many and a candidate's columns few: together they are products of
  // matrices
  std::vector<Eigen::MatrixXd> of_each(FoldProducts const& all, std::span<FoldProducts const> own) const;

  // Over all folds, for combinations of the signals: that with the weights w gains w' form w. m x m
  Eigen::MatrixXd form(FoldProducts const& cross, FoldProducts const& own, FoldProducts const& products) const;

 private:
  struct Fit {
    Eigen::MatrixXd inverse{};      // of A, whose eigenvalues are r at least
    Eigen::MatrixXd gram_inside{};  // N_F' N_F
    Eigen::MatrixXd fit{}, left{};  // b, and N_F' (y_F - N_F b): k x m
  };
  // of one fold: c, W' (y_F - N_F b), W' W
  struct Beside {
    Eigen::MatrixXd fit{}, left{}, square{};
  };
  std::vector<Beside> beside(std::size_t fold, FoldProducts const& all, std::span<FoldProducts const> own) const;

  std::vector<Fit> folds_{};
};

}  // namespace torquescope
