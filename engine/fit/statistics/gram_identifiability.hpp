#pragma once
// Which parameters a recording can tell, before any fit: alone, only with others, or not at all.
//
// Equation   scaled_ij = gram_ij / sqrt(gram_ii gram_jj), its eigenvalues l_k and vectors v_k; a direction is weak when
//            its condition index sqrt(l_max / l_k) exceeds 30; a parameter is in a group when weak directions make more
//            than half of its variance, the sum over k of v_jk^2 / l_k
// Shapes     gram: R x R, Phi' Phi of rows divided by their noise; plausible: R, the largest sizes that parameters may
//            have, or empty
// Not seen   a zero column, or one whose torque at the plausible size is within the noise of all rows together
// Threads    pure function
// Source     Belsley, Kuh, Welsch 1980, doi:10.1002/0471725153, chapter 3 (both limits); the three kinds are those of
//            base parameters of an arm (robot/base_parameters.hpp), here of one motion

#include <Eigen/Core>
#include <vector>

namespace torquescope {

inline constexpr double weak_condition_index = 30.0, shared_variance = 0.5;

enum class Seen { alone, in_a_group, not_at_all };

struct GramIdentifiability {
  std::vector<Seen> seen;                         // R
  std::vector<std::vector<Eigen::Index>> groups;  // parameters that only their sums are told of, ascending, apart
  double condition = 0.0;                         // of the scaled columns that are seen; infinite: dependent
};

GramIdentifiability gram_identifiability(Eigen::MatrixXd const& gram, Eigen::VectorXd const& plausible = {});

}  // namespace torquescope
