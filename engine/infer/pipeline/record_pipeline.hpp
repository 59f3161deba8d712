#pragma once
// What the fit sees of one recording or replicate: the same code for both, so that processing artefacts cannot differ.
//
// Steps      differentiate, columns of the model, parallel filter on torque and columns, reversal mask, weights of the
//            rows by their noise (noise_weights.hpp) where they were set, least squares
// Equation   torque = columns * parameters + residual, on the kept rows: residual is orthogonal to every column, but
//            for parameters that are at a bound (joint_fit.hpp)
// Shapes     motion: n samples at the full rate; rows, torque, columns, residual: the samples that survive decimation,
//            edges and mask, in time order. Memory: about 100 bytes per recorded sample; never keep one per replicate
// Errors     constructor: Error 78, 65 as ParallelFilter; process: 65 when the rows cannot tell the parameters apart
// Threads    const object, any number of threads
// Source     METHOD.md, Rows of a recording; parallel filtering: Gautier 1997, IEEE ICRA

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
#include "engine/infer/pipeline/noise_weights.hpp"

namespace torquescope {

// One that several own and nobody changes: of a long recording each is as large as the file
class SharedMotion {
 public:
  SharedMotion() : SharedMotion(Motion{}) {}
  SharedMotion(Motion motion) : motion_(std::make_shared<Motion const>(std::move(motion))) {}
  operator Motion const&() const { return *motion_; }
  Motion const* operator->() const { return motion_.get(); }

 private:
  std::shared_ptr<Motion const> motion_;
};

// Of a recording: the same for every model under one [filter] section
struct RecordedMotions {
  SharedMotion joint, drive;  // ProcessedRecord::motion and ::drive
};

struct ProcessedRecord {
  SharedMotion motion;                  // full rate, filtered: what candidate columns are computed from
  std::vector<Eigen::Index> kept_rows;  // of the rows below: index among the pipeline's kept samples
  Eigen::MatrixXd columns;              // of the model
  Eigen::VectorXd torque;
  Eigen::VectorXd parameters;  // least squares on these rows
  Eigen::VectorXd residual;
  // before whitening, in torque units throughout; empty where nothing was whitened
  Eigen::MatrixXd plain_columns{};
  Eigen::VectorXd plain_torque{};
  // of the gear load that the recording's torque is without; empty: none
  Eigen::VectorXd beside{};
  // the same with a wider band, for parts that have an inertia; empty in a twin whose model has none
  SharedMotion drive{};
  std::string held{};  // "inertia" or "dry friction" where its fit is at a bound (joint_fit.hpp)

  RecordedMotions motions() const { return {motion, drive}; }
  double energy() const { return residual.squaredNorm(); }
  bool is_whitened() const { return plain_torque.size() > 0; }
  // what errors are relative to
  Eigen::VectorXd whole_torque() const {
    return beside.size() > 0 ? Eigen::VectorXd(torque_itself() + beside) : torque_itself();
  }
  Eigen::VectorXd const& torque_itself() const { return is_whitened() ? plain_torque : torque; }
  Eigen::MatrixXd const& columns_themselves() const { return is_whitened() ? plain_columns : columns; }
  // what the same parameters leave of the torque itself
  Eigen::VectorXd residual_itself() const {
    return is_whitened() ? Eigen::VectorXd(plain_torque - plain_columns * parameters) : residual;
  }
};

class RecordPipeline {
 public:
  // the model's regressor outlives the pipeline; `filter` is the job's [filter] section, for the places in messages
  RecordPipeline(JointModel model, FilterOptions const& options, double rate_hz, Eigen::Index n_samples,
                 Section const& filter = {});

  JointModel const& model() const { return model_; }
  double rate_hz() const { return rate_hz_; }
  Eigen::Index samples() const { return n_samples_; }
  Eigen::Index kept_samples() const { return filter_.kept_samples(); }  // before the mask
  double kept_rate_hz() const { return filter_.kept_rate_hz(); }
  double cutoff_hz() const { return cutoff_hz_; }  // of the parallel filter; 0: none
  ParallelFilter const& parallel_filter() const { return filter_; }
  // what ProcessedRecord::motion and ::drive were low-passed to; 0: neither was
  double motion_band_hz() const { return options_.cutoff_hz; }
  double drive_band_hz() const { return drive_options_.cutoff_hz; }

  // from now on process() keeps exactly these rows, whatever its own mask would be
  void restrict_to(std::vector<Eigen::Index> kept_rows);

  // from now on an inertia that takes less than this share of the torque is held (joint_fit.hpp)
  void hold_inertia_below(double share) { fit_bounds_.least_inertia_share = share; }
  // from now on a held inertia is one that a loop leads round the turns of the motion (joint_fit.hpp)
  void hold_inertia_by_turns() { fit_bounds_.by_turns = true; }
  // from now on a fit bounds effects, or leaves them free
  void bound_effects(bool bounds) { fit_bounds_.of_effects = bounds; }
  bool bounds_effects() const { return fit_bounds_.of_effects; }

  // from now on its own mask drops these samples too, one per sample
  void leave_out(std::vector<bool> samples) { saturated_ = std::move(samples); }
  // rows of a record that moves like this: by its mask, or those it is restricted to
  std::vector<Eigen::Index> own_rows(Motion const& motion) const;
  // every sample that the filter keeps: what residuals are of when nothing is left out
  std::vector<Eigen::Index> all_rows() const;

  // from now on its own mask drops rests alone (reversal_mask.hpp)
  void keep_reversals(bool keeps = true) { keeps_reversals_ = keeps; }
  bool keeps_reversals() const { return keeps_reversals_; }

  // from now on process() weighs rows by what their noise leaves of them; none: every row alike. With weights of
  // reversals these rows are kept
  void weigh_with(std::shared_ptr<NoiseWeights const> weights);
  std::shared_ptr<NoiseWeights const> const& weights() const { return weights_; }
  bool whitens() const { return weights_ && !weights_->are_equal(); }
  // signals on rows, in place
  void whiten(Eigen::Ref<Eigen::MatrixXd> signals, std::vector<Eigen::Index> const& kept_rows) const;
  // the same without the friction random walk: what that walk is measured on
  void whiten_rows(Eigen::Ref<Eigen::MatrixXd> signals, std::vector<Eigen::Index> const& kept_rows) const;
  // by the shares of rows near reversals alone
  void take_shares(Eigen::Ref<Eigen::MatrixXd> signals, std::vector<Eigen::Index> const& kept_rows) const;

  ProcessedRecord process(Recording const& recording) const { return process(motions_of(recording), recording.name); }
  // of motions that motions_of() returned, by any pipeline with the same filter and rate
  ProcessedRecord process(RecordedMotions motions, std::string const& name) const;
  RecordedMotions motions_of(Recording const& recording) const;
  // positions of many recordings, one per column, which share the filter's work; drive: none where the model needs none
  struct SmoothPositions {
    Eigen::MatrixXd joint, drive;
  };
  SmoothPositions smoothed(Eigen::MatrixXd positions) const;
  // differentiated, as process() does
  Motion motion_of(Recording const& recording) const;
  // of a recording whose position is to be that column; nothing where it moves on fewer rows than there are parameters
  std::optional<ProcessedRecord> process_smooth(Recording&& recording, SmoothPositions const& positions,
                                                Eigen::Index column) const;
  // before whitening and least squares: of a recording that need not excite every column; parameters and residual stay
  // empty
  ProcessedRecord prepare(Recording const& recording) const;
  // the same record on fewer of its rows, fitted again; name: of the recording, for the message when that fails
  ProcessedRecord restricted(ProcessedRecord record, std::vector<Eigen::Index> const& kept_rows,
                             std::string const& name) const;
  // any signal of the full rate, filtered like a column, on the rows of that record
  Eigen::VectorXd filtered(Eigen::Ref<Eigen::VectorXd const> const& signal, ProcessedRecord const& record) const;
  Eigen::MatrixXd filtered_columns(Eigen::Ref<Eigen::MatrixXd const> const& signals,
                                   ProcessedRecord const& record) const;
  // the same on all kept samples, whatever the mask
  Eigen::VectorXd filtered(Eigen::Ref<Eigen::VectorXd const> const& signal) const { return filter_.apply(signal); }
  Eigen::VectorXd picked(Eigen::Ref<Eigen::VectorXd const> const& signal) const { return filter_.pick(signal); }
  // the rows' own samples of a signal of the full rate, not filtered: time, velocity
  Eigen::VectorXd picked(Eigen::Ref<Eigen::VectorXd const> const& signal, ProcessedRecord const& record) const;

 private:
  std::vector<Eigen::Index> present_columns(Eigen::MatrixXd const& columns) const;
  bool is_repeated(Eigen::MatrixXd const& columns, Eigen::Index column) const;
  ProcessedRecord prepare(RecordedMotions&& motions) const;
  void fit(ProcessedRecord& record, std::string const& name) const;  // whitens first

  JointModel model_;
  FilterOptions options_, drive_options_;
  Section section_;
  double rate_hz_;
  Eigen::Index n_samples_;
  double cutoff_hz_;
  ParallelFilter filter_;
  std::vector<bool> saturated_{};  // samples that are left out too; empty: none
  bool keeps_reversals_ = false;
  FitBounds fit_bounds_{};
  std::vector<Eigen::Index> fixed_rows_{};  // empty: each recording's own mask
  std::shared_ptr<NoiseWeights const> weights_{};
  WanderOnRows fixed_wander_{};  // on fixed_rows_
};

// Errors     Error 65 when fewer rows are left than wanted; name: of the recording, help: what its owner can do
void require_rows(std::size_t rows, std::size_t wanted, std::string const& name, std::string const& help);
// the help, where a longer recording is not all that can help
inline constexpr char const* fewer_reversals =
    "record a longer motion with fewer reversals per second, or raise filter.parallel_cutoff_hz";

// rows that the filter may couple: three periods of its cut-off
Eigen::Index guard_rows(RecordPipeline const& pipeline);

}  // namespace torquescope
