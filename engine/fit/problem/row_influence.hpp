#pragma once
// How far one row of a recording moves the parameters of a least-squares fit, against all other rows together.
//
// Equation   change d_b = (Phi'Phi - Phi_b'Phi_b)^-1 Phi_b' e_b of the parameters by a block b of rows (a filter
//            spreads one sample over it). Their error without b: s^2 = sum over the other blocks of d^2 in the fit
//            without b (delete-a-group jackknife)
// Above one  |d_b| / s: the block outweighs all others together. Of B like blocks the largest is about sqrt(2 ln B / B)
// Shapes     n rows; half_width: rows at each side that share a sample; none where there are less than ten blocks
// Source     DFBETAS: Belsley, Kuh, Welsch 1980, Regression Diagnostics, ch. 2, doi:10.1002/0471725153; the jackknife:
//            Shao, Tu 1995, section 2.3, doi:10.1007/978-1-4612-0795-5

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "engine/fit/problem/regression_data.hpp"

namespace torquescope {

struct RowInfluence {
  Eigen::Index parameter = 0;
  double without = 0.0;  // value of the parameter without the row
  double change = 0.0;   // by the row
  double errors = 0.0;   // |change| in standard errors without the row
};

class RowInfluences {
 public:
  RowInfluences(RegressionData const& data, Eigen::VectorXd const& parameters, Eigen::Index half_width);
  ~RowInfluences();
  // on each parameter
  std::vector<RowInfluence> of(Eigen::Index row) const;

 private:
  struct State;
  std::unique_ptr<State const> state_;
};

}  // namespace torquescope
