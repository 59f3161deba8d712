#pragma once
// The linear problem tau = phi * parameters of one joint, after the parallel filter: what every estimator works on.
//
// Shapes     n rows over all recordings, one after the other; R columns
// Units      s, rad or m, N m or N; rates in Hz
// Errors     make_regression_data: Error 78, 65 as differentiate() and ParallelFilter; 65 when recordings keep unequal
//            rates (rows would weigh unequal times)
// Threads    plain record
// Source     parallel filtering: Gautier 1997; Janot, Vandanjon, Gautier 2014

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/data/motion.hpp"
#include "engine/data/recording.hpp"
#include "engine/effects/regressor.hpp"

namespace torquescope {

class ArmModel;

struct RegressionData {
  Eigen::MatrixXd phi;                   // [n][R], filtered like the torque
  Eigen::VectorXd tau;                   // [n]
  std::vector<RegressorColumn> columns;  // [R] names, units and needs

  // the kept samples, for people and plots; time restarts with each recording. RowMotion::once leaves empty what phi or
  // the rate tell as well: time(), velocity() and acceleration() know where
  Eigen::VectorXd time_s;
  Eigen::VectorXd q;
  Eigen::VectorXd dq;
  Eigen::VectorXd ddq;
  std::vector<Eigen::Index> first_row{0, 0};  // [recordings + 1]; recording k owns rows first_row[k] .. first_row[k+1]

  // rows of an arm (arm_regression.hpp); of a single joint nothing. A block of first_row holds a joint's rows of one
  // recording then
  struct Arm {
    std::vector<std::size_t> joint;           // [recordings()] whose rows the block holds
    std::vector<Eigen::Index> instant;        // [n] rows of several joints at the same time have the same
    std::vector<Eigen::Index> first_instant;  // [files + 1]
    Eigen::VectorXd scale;                    // [joints] rows of a joint were divided by it: its noise, N m or N
    std::shared_ptr<ArmModel const> model{};  // whose columns these are
    std::vector<Eigen::Index> gain_column{};  // [joints] of the error of its gain; empty: gains are no parameters
    // [n][R] phi along the motion that an arm of these parameters makes without noise; none unless an estimator asks
    std::function<Eigen::MatrixXd(Eigen::VectorXd const& parameters)> instruments{};

    std::size_t joints() const { return static_cast<std::size_t>(scale.size()); }
  };
  std::optional<Arm> arm{};

  std::vector<std::string> recording_names;  // [recordings]
  std::vector<double> rate_hz;               // [recordings] as recorded
  double kept_rate_hz = 0.0;                 // of the rows

  Eigen::Index rows() const { return tau.size(); }
  Eigen::Index parameters() const { return phi.cols(); }
  std::size_t recordings() const { return first_row.size() - 1; }
  std::size_t recording_of(Eigen::Index row) const;

  // of the rows from first_row on
  void time(std::size_t first_row, std::span<double> seconds) const;
  std::span<double const> velocity() const;
  std::span<double const> acceleration() const;

  // velocities of both signs, also of a motion that is forgotten
  bool moves_both_ways() const;
  void note_directions(std::span<double const> velocity);
  // frees time_s, q, dq and ddq: a fit needs none of them
  void forget_motion();

  // columns of phi that are the velocity and the acceleration, bit for bit
  struct SameColumns {
    std::optional<Eigen::Index> velocity{}, acceleration{};
  };
  SameColumns same_columns{};

 private:
  bool forgotten_forwards_ = false, forgotten_backwards_ = false;
};

// what is wanted beside phi and tau: time_s, q, dq and ddq (several recordings); of them what phi and rate do not tell
// (a single recording); nothing. What is not kept makes room for phi while it is made
enum class RowMotion { kept, once, used_up };

// the next recording's rows, below those that are there; takes the motion
void append_rows(RegressionData& data, std::string const& recording_name, Motion&& motion, FilterOptions const& options,
                 Regressor const& regressor, Section const& filter, RowMotion row_motion = RowMotion::kept);

// differentiate, columns, parallel filter on torque and every column, one recording after the other;
// `filter` is the job's [filter] section, for the places in messages
RegressionData make_regression_data(std::vector<Recording> const& recordings, FilterOptions const& options,
                                    Regressor const& regressor, Section const& filter);

}  // namespace torquescope
