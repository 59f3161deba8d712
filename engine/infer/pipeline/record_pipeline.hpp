#pragma once
// The rows of one recording on which a model without effects is looked at before a decision: those that move one way.
//
// Steps      differentiate, columns of the model, parallel filter on torque and columns, reversal mask, least squares
// Equation   torque = columns * parameters + residual, on the kept rows: residual is orthogonal to every column, but
//            for parameters that are at a bound (joint_fit.hpp)
// Use        checks of a recording, a simulator's share, other joints that load it. A decision takes all samples
//            (decision/strip.hpp)
// Shapes     motion: n samples at the full rate; rows, torque, columns, residual: the samples that survive decimation,
//            edges and mask, in time order
// Errors     constructor: Error 78, 65 as ParallelFilter; process: 65 when the rows cannot tell the parameters apart
// Threads    const object, any number of threads; source: parallel filtering, Gautier 1997, IEEE ICRA

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/data/motion.hpp"
#include "engine/data/recording.hpp"
#include "engine/infer/pipeline/joint_bounds.hpp"
#include "engine/infer/pipeline/joint_model.hpp"

namespace torquescope {

struct ProcessedRecord {
  Motion motion{};                        // full rate, filtered
  std::vector<Eigen::Index> kept_rows{};  // of the rows below: index among the pipeline's kept samples
  Eigen::MatrixXd columns{};              // of the model
  Eigen::VectorXd torque{};
  Eigen::VectorXd parameters{};  // least squares on these rows
  Eigen::VectorXd residual{};
  Eigen::VectorXd beside{};  // of the gear load that the recording's torque is without; empty: none
  std::string held{};        // "inertia" or "dry friction" where its fit is at a bound (joint_fit.hpp)

  // what errors are relative to
  Eigen::VectorXd whole_torque() const { return beside.size() > 0 ? Eigen::VectorXd(torque + beside) : torque; }
};

class RecordPipeline {
 public:
  // the model's regressor outlives the pipeline; `filter` is the job's [filter] section, for the places in messages
  RecordPipeline(JointModel model, FilterOptions const& options, double rate_hz, Eigen::Index n_samples,
                 Section const& filter = {});

  JointModel const& model() const { return model_; }
  double rate_hz() const { return rate_hz_; }
  Eigen::Index samples() const { return n_samples_; }
  double kept_rate_hz() const { return filter_.kept_rate_hz(); }
  double cutoff_hz() const { return cutoff_hz_; }  // of the parallel filter; 0: none

  ProcessedRecord process(Recording const& recording) const;
  // before least squares: of a recording that need not excite every column; parameters and residual stay empty
  ProcessedRecord prepare(Recording const& recording) const;
  Motion motion_of(Recording const& recording) const;
  // any signal of the full rate, filtered like a column, on the rows of that record
  Eigen::VectorXd filtered(Eigen::Ref<Eigen::VectorXd const> const& signal, ProcessedRecord const& record) const;
  Eigen::MatrixXd filtered_columns(Eigen::Ref<Eigen::MatrixXd const> const& signals,
                                   ProcessedRecord const& record) const;

 private:
  std::vector<Eigen::Index> own_rows(Motion const& motion) const;

  JointModel model_;
  FilterOptions options_;
  Section section_;
  double rate_hz_;
  Eigen::Index n_samples_;
  double cutoff_hz_;
  ParallelFilter filter_;
};

// Errors     Error 65 when fewer rows are left than wanted; name: of the recording, help: what its owner can do
void require_rows(std::size_t rows, std::size_t wanted, std::string const& name, std::string const& help);
// the help, where a longer recording is not all that can help
inline constexpr char const* fewer_reversals =
    "record a longer motion with fewer reversals per second, or raise filter.parallel_cutoff_hz";

// rows that the filter may couple: three periods of its cut-off
Eigen::Index guard_rows(RecordPipeline const& pipeline);

}  // namespace torquescope
