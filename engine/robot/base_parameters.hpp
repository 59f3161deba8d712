#pragma once
// Base parameters of an arm: the sums of standard parameters that its torques depend on, no more and no less.
//
// Equation   Phi chi = Phi[:, columns] chi_base, chi_base_k = chi[column_k] + sum of factor * chi[column]
// Rule       pinned by order, not by pivots: links from the tip to the base, of each zz, xy, xz, yz, mx, my, xx when
//            independent of those kept before; then drive inertias; then mz, yy, m. Listed in the order of the columns.
//            One that gathers others has an r in its name: xxr2 = xx2 - yy2 - 0.0929 (m3 + m4). Angles that are almost
//            right make columns that are almost sums: these stand last
// Threads    immutable after the constructor
// Source     Gautier and Khalil 1990, doi:10.1109/70.56655 (which columns stand); Gautier 1991,
//            doi:10.1002/rob.4620080405 (numerical gathers)

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/robot/serial_chain.hpp"

namespace torquescope {

struct GatheredTerm {
  Eigen::Index column;  // of the standard parameters
  double factor;
};

struct BaseParameter {
  std::string name;                   // "xxr2", "mx3", "drive_3"
  std::string unit;                   // "kg m^2"
  Eigen::Index column;                // the standard column that stands
  Eigen::Index first_row, last_row;   // rows of the regressor that have this column: 0 to its link's, or a drive's
  std::vector<GatheredTerm> gathers;  // what joins it, without itself
};

class BaseParameters {
 public:
  BaseParameters(SerialChain const& chain, DriveInertias drives);

  std::vector<BaseParameter> const& parameters() const { return parameters_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(parameters_.size()); }
  std::vector<Eigen::Index> const& columns() const { return columns_; }  // ascending: those of parameters()
  Eigen::Index standard_size() const { return standard_size_; }
  std::vector<std::string> const& standard_names() const { return standard_names_; }
  // standard parameters that move no joint whatever the motion
  std::vector<std::string> const& without_effect() const { return without_effect_; }

  // columns of a standard regressor that stand
  Eigen::MatrixXd pick(Eigen::Ref<Eigen::MatrixXd const> const& regressor) const;
  Eigen::VectorXd from_standard(Eigen::Ref<Eigen::VectorXd const> const& standard) const;
  // the values in the columns that stand, 0 in the others: gives the same torques, energies and accelerations
  Eigen::VectorXd to_standard(Eigen::Ref<Eigen::VectorXd const> const& values) const;

 private:
  std::vector<BaseParameter> parameters_;
  std::vector<Eigen::Index> columns_;
  std::vector<std::string> standard_names_, without_effect_;
  Eigen::Index standard_size_ = 0;
};

}  // namespace torquescope
