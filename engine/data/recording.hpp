#pragma once
// A recording as the engine uses it: evenly sampled, SI units, checked. Made by recording_reader.hpp from a file.
//
// Shapes     every vector has n_samples entries; absent channels are empty
// Units      s; rad or m; rad/s or m/s; N m or N (revolute or prismatic joint)
// Threads    plain record

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "engine/data/finding.hpp"
#include "engine/data/given_signals.hpp"

namespace torquescope {

// something a person should know about the data, which does not stop a run
struct DataWarning {
  std::string topic;  // "jitter", "saturation", "delay", "excitation", "separable"
  std::string text;   // "time stamps uneven by 3 % of a step, ..."
};

// what only the rows of the file show, before they were resampled; zeros for a simulated recording
struct RowFacts {
  double jitter = 0.0;                        // rms deviation of the time steps from their median, share of a step
  Eigen::Index resampled = 0;                 // samples that do not stand where a row stood
  Eigen::Index repeated = 0;                  // rows dropped because their time stamp repeats
  Eigen::Index missing = 0;                   // rows the clock says are missing
  double position_hz = 0.0, torque_hz = 0.0;  // at which the channel was renewed, where less often than logged
  double encoder_step = 0.0;        // smallest step of the position (rad or m); 0: not quantised, or too finely to see
  double torque_limit_share = 0.0;  // share of time the torque sits exactly at its largest or smallest value
};

// s since the first sample, both ends known
struct Stretch {
  double from_s = 0.0, until_s = 0.0;
};

// a row that stands out from its neighbours (health/lone_rows.hpp)
struct LoneRow {
  double time_s = 0.0;  // as in Recording::time_s
  double value = 0.0;   // of the file's column
  std::int64_t line = 0;
  std::string column{};
};

enum class LeftOutReason {
  asked_for,  // recording.leave_out
  no_rows,    // a gap of the clock
  no_value    // a channel holds none, or none that can be true, over more samples than are filled
};
struct LeftOutStretch {
  Stretch where{};
  LeftOutReason reason = LeftOutReason::no_value;
  std::string column{};   // of the channel without a value
  bool of_motion = true;  // nobody knows how the joint moved: joints that feel it need it too. false: only its torque
};

struct Recording {
  std::string name;    // file name without its folder, or "simulated"
  std::string sha256;  // of the bytes that were parsed (before decompression), or of the simulated numbers
  double rate_hz = 0.0;
  Eigen::VectorXd time_s;
  Eigen::VectorXd position;
  Eigen::VectorXd torque;              // motor torque or force: column times torque_per_unit
  Eigen::VectorXd reference{};         // commanded position, optional
  Eigen::VectorXd velocity{};          // optional: used instead of differentiating the position
  Eigen::VectorXd acceleration{};      // optional, only together with velocity
  Eigen::VectorXd simulated_torque{};  // optional: the user's own simulator on the same motion
  std::string torque_unit{};           // "mA": the column's, where torque_per_unit does not say more; "": N m or N
  // optional, for rollouts: that simulator's motion from the reference; what is added to the drive's command, in the
  // column's own unit; torque from outside; whether the drive is on (1) or off (0)
  Eigen::VectorXd simulated_position{};
  Eigen::VectorXd added_command{}, external_torque{}, enabled{};
  // what passes the gear beside the terms of a model, as that simulator says; no channel: a diagnosis fills it
  Eigen::VectorXd gear_load{};
  // other joints of the file that move, where OtherJoints::kept asked for them: n x their columns, units as position
  Eigen::MatrixXd other_positions{};
  std::vector<std::string> other_columns{};
  // what the other joints of an arm do to this one; no channel: a diagnosis fills it
  std::shared_ptr<GivenSignals const> given{};
  std::vector<DataWarning> warnings{};
  std::vector<Finding> findings{};                 // of the examination (engine/data/health)
  std::vector<Stretch> left_out{};                 // no row within them is fitted: what stands there was filled
  std::vector<LeftOutStretch> left_out_because{};  // the same stretches one by one; they may overlap
  RowFacts rows{};
  std::vector<LoneRow> lone{};
};

}  // namespace torquescope
