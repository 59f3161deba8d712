#pragma once
// One joint in one recording or replicate, ready for effects: every sample stays in.
//
// Rate       effects are computed at every step-th sample, at least six times the cut-off of the parallel filter and
//            2.56 times the band of the motion; rows are the samples that this filter keeps. drive: the same motion
//            with a wider band at a rate of its own, for parts that have an inertia
// Quiet      samples at which the raw position stays within one step of the encoder for half a period of the motion's
//            cut-off: whether the joint moves there nobody can tell. Without steps, within four standard deviations of
//            the position's noise
// Direction  -1 or 1, kept until the position has come back by 1.5 steps; low-passed as the torque is
// Left out   stretches that were filled, a torque at its limit, the filter's edges: nothing else
// Shapes     motion, torque, direction, quiet: n at the effects' rate. Units: SI
// Threads    plain records; filters are shared between a recording and its replicates
// Source     engine/infer/decision/THEORY.md, Rows; parallel filter: Gautier 1997, IEEE ICRA

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "engine/data/motion.hpp"
#include "engine/data/recording.hpp"
#include "engine/infer/pipeline/joint_model.hpp"

namespace torquescope {

// what a recording and its replicates go through alike
struct StripFilters {
  FilterOptions options{}, drive_options{};
  double rate_hz = 0.0;  // of the recording
  double cutoff_hz = 0.0;
  Eigen::Index step = 1, drive_step = 1, samples = 0;
  std::shared_ptr<ParallelFilter const> whole{}, effects{}, drive{};  // of every, step-th and drive_step-th sample
};

// Errors     Error 78, 65 as ParallelFilter
std::shared_ptr<StripFilters const> strip_filters(Recording const& recording, FilterOptions const& options,
                                                  Section const& section);

struct Strip {
  std::shared_ptr<StripFilters const> filters{};
  Motion motion{}, drive{};
  Eigen::VectorXd torque{};  // low-passed below half of the effects' rate
  Eigen::VectorXd direction{};
  Eigen::MatrixXd sides{};  // of friction that does not turn round at once (sticking_shape.hpp)
  std::vector<char> is_quiet{};
  std::vector<Eigen::Index> rows{};  // among the samples that the filter keeps; 2.56 for each Hz of its cut-off
  Eigen::Index rows_apart = 1;
  Eigen::VectorXd row_weight{};  // of each row, 0 to 1 (row_weights.hpp); empty: all 1
  double resolution = 0.0;       // rad or m: what the position shows
  BaselineReference beside{};    // gear load and given signals at the effects' rate; nothing else of it is set

  Eigen::Index size() const { return motion.q.size(); }
  double duration_s() const { return static_cast<double>(size()) / motion.rate_hz; }
  double quiet_share() const;
  double row_share() const;  // of the samples that the filter keeps
  // samples that the filter couples, in rows
  Eigen::Index memory() const;
};

// of one joint: read by every model that is fitted to them, and many of samples
using SharedStrips = std::shared_ptr<std::vector<Strip> const>;
inline SharedStrips share(std::vector<Strip> strips) {
  return std::make_shared<std::vector<Strip> const>(std::move(strips));
}

// resolution: known already; 0: of the recording
Strip strip_of(Recording const& recording, std::shared_ptr<StripFilters const> const& filters, double resolution = 0.0);

// of signals at the effects' rate: filtered, on the strip's rows
Eigen::MatrixXd on_rows(Strip const& strip, Eigen::Ref<Eigen::MatrixXd const> const& signals);
// the same at the drive's rate
Eigen::MatrixXd drive_on_rows(Strip const& strip, Eigen::Ref<Eigen::MatrixXd const> const& signals);
// a signal of the effects' rate at the drive's: the nearest sample
Eigen::VectorXd at_drive_rate(Strip const& strip, Eigen::VectorXd const& signal);

// what the position shows: the encoder's step, or four standard deviations of its noise
double position_resolution(Recording const& recording);

}  // namespace torquescope
