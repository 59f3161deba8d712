#pragma once
// What of a torque column no function of the motion explains: where a column's own faults show, whatever physics lacks.
//
// Motion     the model's columns, and beside them smooth functions of position and velocity, dry friction that depends
//            on position and load: filtered like the torque
// Shapes     n samples as recorded, r rows looked at (at most 20 000: evenly chosen)
// Units      N m or N, s
// Errors     none where differentiate() has none; too few rows: no value
// Threads    const object, any number of threads

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "engine/data/motion.hpp"
#include "engine/effects/regressor.hpp"

namespace torquescope {

class TorqueBesideMotion {
 public:
  // `filter`: the job's section, for the places in messages
  static std::optional<TorqueBesideMotion> of(Recording const& recording, FilterOptions const& options,
                                              Regressor const& regressor, Section const& filter);
  // the same where the model's columns are known already: [n][k], of a joint of an arm
  static std::optional<TorqueBesideMotion> of(Motion const& motion, Eigen::MatrixXd const& model_columns,
                                              FilterOptions const& options, Section const& filter);
  // the same motion with another torque, [n]
  TorqueBesideMotion with(Eigen::VectorXd const& torque) const;

  Eigen::VectorXd const& left() const { return left_; }           // [r] of the torque
  Eigen::VectorXd const& time_s() const { return time_s_; }       // [r] as in the recording
  Eigen::MatrixXd const& scaled() const { return scaled_; }       // [r][4] sign of speed, position, speed, acceleration
  Eigen::MatrixXd left_of(Eigen::MatrixXd columns) const;         // [r][k] less what the motion explains
  Eigen::VectorXd filtered(Eigen::VectorXd const& signal) const;  // n -> r, as the torque was
  double torque_rms() const { return torque_rms_; }
  double error() const;  // rms of left() over that of the torque

 private:
  TorqueBesideMotion(std::shared_ptr<ParallelFilter const> filter, std::vector<Eigen::Index> rows)
      : filter_(std::move(filter)), rows_(std::move(rows)) {}
  void take(Eigen::VectorXd const& torque);

  std::shared_ptr<ParallelFilter const> filter_;
  std::vector<Eigen::Index> rows_;  // of the filter's
  Eigen::MatrixXd basis_, scaled_;
  Eigen::VectorXd left_, time_s_;
  double torque_rms_ = 0.0;
};

// energy of `signal` that least squares on the columns takes; columns that repeat others take nothing
double energy_within(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns);

}  // namespace torquescope
