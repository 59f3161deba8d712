#pragma once
// The columns of every candidate on a recording, for other methods: same pipeline, catalogue and search of shapes, but
// no replicates.
//
// Rows       those of a decision (decision/strip.hpp): all samples, those at rest as the model treats them; a delay of
//            the torque is no nuisance here, it is a candidate
// Motion     the recording's own, filtered
// Shape      where the effect leaves least of the least-squares residual on held-out folds: grid (shape_grid.hpp), then
//            the refinement of a decision. `grid_points` says how much was searched
// Validation the same columns, at the shape found in training, on every validation recording
// Simulator  a recording with a simulator's torque is exported less what that simulator explains
// Units      SI. Errors: as joint_strips()
// Threads    spreads effects over `threads`; same bits for any number

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/diagnose/joint_diagnosis.hpp"

namespace torquescope {

struct RecordColumns {
  std::string recording{};
  double kept_rate_hz = 0.0;
  double cutoff_hz = 0.0;                 // of the parallel filter: rows closer than its periods repeat each other
  std::vector<Eigen::Index> kept_rows{};  // of each row: index among the kept samples; above 1 a row was left out
  Eigen::VectorXd time_s{}, q{}, dq{}, ddq{};
  Eigen::VectorXd torque{};                   // filtered
  Eigen::MatrixXd regressor{};                // of the model, filtered
  std::vector<Eigen::MatrixXd> candidates{};  // of each of ColumnExport::candidates: n x n_linear, filtered
};

struct ShapedCandidate {
  Effect const* effect = nullptr;
  std::vector<double> shape{};
  std::size_t grid_points = 0;
  double gain = 0.0;  // energy of the residual that it explains there
};

struct ColumnExport {
  std::vector<ShapedCandidate> candidates{};  // explain something
  std::vector<Effect const*>
      not_testable{};  // explain nothing: the model does already, or the allowed sign is the wrong one
  RecordColumns train;
  std::vector<RecordColumns> validate{};
};

ColumnExport export_columns(DiagnosisInput const& input);

}  // namespace torquescope
