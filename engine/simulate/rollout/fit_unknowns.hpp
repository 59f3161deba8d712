#pragma once
// What a fit by simulation searches: the parameters of a model, and what each track has of its own: where it begins
// beside its measured state, and its offset beside the mean one of all.
//
// Starts     position and speed at the first sample of each track that is one segment in a loop; windows and tracks
//            with gaps begin as measured
// Offset     of the model is the mean over the tracks; each has its own where the model has one and tracks are several
// Scale      of a parameter that cannot be negative: at most its own size, so that a difference does not pass its end
// Units      SI
// Threads    const object; residuals_at() spreads trials over `threads`

#include <Eigen/Core>
#include <vector>

#include "engine/simulate/rollout/rollout_model.hpp"
#include "engine/simulate/rollout/rollout_residuals.hpp"

namespace torquescope {

struct FitPoint {
  Eigen::VectorXd parameters, starts;

  double& operator[](Eigen::Index k) { return k < parameters.size() ? parameters[k] : starts[k - parameters.size()]; }
};

class FitUnknowns {
 public:
  // model and tracks outlive this
  FitUnknowns(RolloutModel const& model, std::vector<RolloutTrack> const& tracks, CountedChannels counts,
              bool fits_starts);

  RolloutModel const& model() const { return model_; }
  std::vector<RolloutTrack> const& tracks() const { return task_.tracks; }
  Eigen::Index size() const { return parameters() + n_starts_; }
  Eigen::Index parameters() const { return static_cast<Eigen::Index>(model_.size()); }
  FitPoint begin_at(Eigen::VectorXd const& parameters) const;
  // offsets of the tracks, which are the last of the starts
  Eigen::Index offsets() const { return first_offset_ < 0 ? 0 : n_starts_ - first_offset_; }
  // within its bounds
  double clipped(Eigen::Index k, double value) const;
  double scale(FitPoint const& at, Eigen::Index k) const;
  bool is_at_bound(FitPoint const& at, Eigen::Index k) const;

  // one per track, [samples][points]
  std::vector<TrackResiduals> residuals_at(std::vector<FitPoint> const& points, int threads) const;
  // the same as trials, for who changes something about them
  std::vector<RolloutTrial> trials_on(std::size_t track, std::vector<FitPoint> const& points) const;
  RolloutTask const& task() const { return task_; }

 private:
  double scale_of_start(Eigen::Index start) const;
  double offset_step(std::size_t track, FitPoint const& point) const;

  RolloutModel const& model_;
  RolloutTask task_;
  std::vector<Eigen::Index> first_start_{};  // of each track; -1: it begins as measured
  Eigen::Index first_offset_ = -1;  // of the second track; the first makes up for the others; -1: all share one
  double offset_scale_ = 1.0;
  Eigen::Index n_starts_ = 0;
};

}  // namespace torquescope
