#pragma once
// An identified arm as a robot file: the bodies closest to its base parameters, and a word on which numbers are known.
//
// Reads      /robot and /arm of a result (RESULT_FORMAT.md)
// Errors     Error 65 when the result is of no arm, or its tables do not fit each other; those of ResultReader
// Threads    as ResultReader

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/robot/base_parameters.hpp"
#include "engine/store/result_reader.hpp"

namespace torquescope {

struct IdentifiedArm {
  SerialChain chain{};     // as the robot file had it when the arm was identified
  bool has_limits = true;  // no: an earlier version kept neither limits nor drives
  DriveInertias drives = DriveInertias::included;
  std::vector<std::string> effect_words{};  // "stribeck_speed_2 = 0.03": shapes of its effects
  Eigen::MatrixXd information{};            // of all parameters: inverse of their covariance
};

IdentifiedArm read_identified_arm(ResultReader const& reader);

struct ExportFormat {
  std::string name, meaning;  // "urdf"
};
std::vector<ExportFormat> export_formats();

struct ArmExport {
  std::string text;                // the file
  std::vector<std::string> notes;  // what it says of its numbers, as in the file
  double distance = 0.0;           // standard errors that consistency cost
};

// what the bodies stay near to where the parameters leave them open: cubes, or the inertias of the job's robot file
enum class NearBodies { cubes, robot_file };

// one estimator's parameters of the arm
struct ArmEstimate {
  std::vector<std::string> names;  // base parameters first
  Eigen::VectorXd values;
  Eigen::VectorXd standard{};  // of every link, where it has bodies of its own; else empty
};

// the bodies of an estimator that has some; empty of others
Eigen::VectorXd read_standard_parameters(ResultReader const& reader, std::string const& estimator);

// Error 64 when near the robot file is asked for and the file has no inertias, or its links are no bodies
ArmExport export_arm(IdentifiedArm const& arm, ArmEstimate const& estimate, std::string const& format,
                     NearBodies near = NearBodies::cubes);

}  // namespace torquescope
