#pragma once
// What the mask leaves out of an error: how much of the time, how much of the residual's energy, and the error with it.
//
// Rows       kept samples of the filter, edges dropped; left out: near reversals and rests (reversal_mask.hpp), a
//            saturated torque, the unknown start
// Shapes     torque, left_before, left_after: all kept samples; kept_rows: those that count, ascending
// Units      shares: 1; energies: torque squared
// Threads    pure function

#include <Eigen/Core>
#include <vector>

namespace torquescope {

struct LeftOutRows {
  double rows = 0.0, rows_left_out = 0.0;
  double energy = 0.0, energy_left_out = 0.0;  // of the baseline's residual, over all rows; on those left out
  double torque = 0.0, after = 0.0;            // energies over all rows; after: of the residual with the names

  double time_share() const { return rows > 0.0 ? rows_left_out / rows : 0.0; }
  bool is_raised() const { return after > energy; }  // over all rows, by the names
  double energy_share() const { return energy > 0.0 ? energy_left_out / energy : 0.0; }
  LeftOutRows& operator+=(LeftOutRows const& other);
};

LeftOutRows left_out_rows(Eigen::VectorXd const& torque, Eigen::VectorXd const& left_before,
                          Eigen::VectorXd const& left_after, std::vector<Eigen::Index> const& kept_rows);

}  // namespace torquescope
