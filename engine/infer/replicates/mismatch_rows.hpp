#pragma once
// The recording and its replicates on the same rows: what every statistic of a diagnosis is computed from.
//
// Common motion  of a replicate without noise and encoder: candidate columns and axes are computed from it, once, so
// that no noise of a measured motion enters the statistic
// Rows           kept samples at which the recording, the common motion and the pilot replicates all surely move one
// way; with reversals: all but rests
// Residual       torque - own columns * own least squares, filtered and whitened alike. The plain ones are the same
// before whitening, empty where nothing was whitened
// Shapes         n rows in time order, M replicates: 8 n M bytes
// Units          SI
// Threads        plain record

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/infer/pipeline/motion_axes.hpp"
#include "engine/infer/pipeline/record_pipeline.hpp"
#include "engine/infer/replicates/twin_exchange.hpp"
#include "engine/simulate/clean_twin.hpp"

namespace torquescope {

// axes: of the common motion, per row
struct MismatchRows : MotionAxes {
  double rate_hz = 0.0;                   // of the kept samples before the mask
  std::vector<Eigen::Index> kept_rows{};  // of each row: index among the pipeline's kept samples
  Eigen::VectorXd torque{};               // of the recording with its gear load, filtered, never whitened
  Eigen::VectorXd residual{};             // of the recording
  Eigen::VectorXd twin_mean{};            // mean residual of the twins
  Eigen::MatrixXd twins{};                // n x M: residual of each twin
  Eigen::VectorXd plain_residual{};
  Eigen::MatrixXd plain_twins{};

  Eigen::Index size() const { return residual.size(); }
  Eigen::Index n_twins() const { return twins.cols(); }
};

// the same rows with residuals as they are in the torque itself
MismatchRows in_torque_itself(MismatchRows rows);

// the recording, its noiseless twin and M noisy ones on common rows
struct TwinComparison {
  MismatchRows rows;
  ProcessedRecord recording;  // on those rows
  ProcessedRecord common;     // of the twin without noise, on those rows
  Eigen::MatrixXd twin_fits;  // M x model.size(): least squares of each twin
  bool ran_away = false;      // the twin cannot follow the reference: nothing else is filled
};

// pipeline: its rows become the common ones.  twins >= 8
// Errors     as the pipeline; Error 65 when fewer than 100 rows, or 10 per parameter, are left
// Threads    spreads twins over the threads and processes of `workers`; same bits for any number
TwinComparison compare_with_twins(RecordedMotions const& recording, std::string const& name, CleanTwin const& twin,
                                  RecordPipeline& pipeline, TwinAddress const& address, std::size_t twins,
                                  TwinWorkers const& workers);
inline TwinComparison compare_with_twins(Recording const& recording, CleanTwin const& twin, RecordPipeline& pipeline,
                                         TwinAddress const& address, std::size_t twins, TwinWorkers const& workers) {
  return compare_with_twins(pipeline.motions_of(recording), recording.name, twin, pipeline, address, twins, workers);
}

}  // namespace torquescope
