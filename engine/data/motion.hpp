#pragma once
// Filtered motion of one joint at the full sampling rate: what regressor columns are computed from.
//
// The torque in here is still raw: torque and columns go through the same low-pass and decimation together (the
// parallel filter of ParallelFilter), after the columns were computed from the filtered motion.
//
// Shapes     n_samples each
// Units      s, rad, rad/s, rad/s^2, N m (prismatic: m, m/s, m/s^2, N)
// Source     Gautier 1997, "Dynamic identification of robots with power model"; Janot, Vandanjon, Gautier 2014

#include <Eigen/Core>
#include <memory>

#include "engine/base/options.hpp"
#include "engine/data/recording.hpp"

namespace torquescope {

struct Motion {
  double rate_hz = 0.0;
  Eigen::VectorXd time_s;
  Eigen::VectorXd q;
  Eigen::VectorXd dq;
  Eigen::VectorXd ddq;
  Eigen::VectorXd torque;  // not filtered
  std::vector<Stretch> left_out{};
  std::vector<LeftOutStretch> left_out_because{};  // the same one by one
};

// first to end (not in it); empty where first >= end
struct SampleRange {
  Eigen::Index first = 0, end = 0;
};
// of n samples, what one stretch leaves out: as below
SampleRange samples_left_out(Stretch const& stretch, Eigen::Index n, double rate_hz, double cutoff_hz);

// samples that no row may stand for: those of left_out, and as far around them as a filter of this cut-off remembers
std::vector<bool> left_out_samples(Motion const& motion, double cutoff_hz);

struct FilterOptions {
  double cutoff_hz = 0.0;           // low-pass of the position before differentiation; 0: none
  std::int64_t order = 4;           // Butterworth order, run forwards and backwards (zero phase)
  double parallel_cutoff_hz = 0.0;  // low-pass of torque and every regressor column; 0: 0.4 * decimate_to_hz, or none
  double decimate_to_hz = 0.0;      // rate kept for the fit; 0: the recording's
  double edge_s = -1.0;             // dropped at both ends; negative: three periods of the lowest cutoff

  static OptionTable<FilterOptions> const& table();
};

// low-passes the position (zero phase) and differentiates it twice by central differences; given velocity and
// acceleration channels are used as they are (low-passed alike)
// Errors     Error 78 when a cutoff is not below half the rate, 65 when the recording is shorter than the filter
Motion differentiate(Recording const& recording, FilterOptions const& options, Section const& section);
// the same, out of the recording's own channels: nothing is copied that need not change
Motion differentiate(Recording&& recording, FilterOptions const& options, Section const& section);
// the two steps of it for many recordings of a position alone: eight positions, one per column, cost as much as one
Eigen::MatrixXd smooth_positions(Eigen::Ref<Eigen::MatrixXd const> const& positions, FilterOptions const& options,
                                 double rate_hz);
Motion differentiate_smooth(Recording&& recording);
// [n] central differences inside, one-sided at both ends; n > 1
Eigen::VectorXd central_derivative(Eigen::Ref<Eigen::VectorXd const> const& signal, double rate_hz);
// every step-th sample from `first` on: of a motion that was low-passed for the rate that is left
Motion thinned(Motion const& motion, Eigen::Index first, Eigen::Index step);

// The same low-pass, decimation and edge cut for torque and every column.
class ParallelFilter {
 public:
  // Errors     as differentiate()
  ParallelFilter(FilterOptions const& options, double rate_hz, Eigen::Index n_samples, Section const& section);
  ~ParallelFilter();
  ParallelFilter(ParallelFilter&&) noexcept;

  Eigen::Index kept_samples() const;  // after decimation and edge cut
  double kept_rate_hz() const;
  bool keeps_everything() const;  // neither low-pass nor decimation nor edge: apply() changes nothing
  Eigen::VectorXd apply(Eigen::Ref<Eigen::VectorXd const> const& signal) const;  // n_samples -> kept_samples()
  // every column of n_samples x k
  Eigen::MatrixXd apply_columns(Eigen::Ref<Eigen::MatrixXd const> const& signals) const;
  Eigen::VectorXd pick(Eigen::Ref<Eigen::VectorXd const> const& signal) const;  // the same samples, not low-passed

  // of kept samples so many apart, where the signal was white noise
  double neighbour_correlation(Eigen::Index apart = 1) const;
  Eigen::Index decimation() const;       // samples from one that is kept to the next
  // The same for signals of which every step-th sample is there, from first_of(step) on: it keeps the same samples.
  // Requires   step divides decimation(), and the cut-off lies below half the rate that is left
  ParallelFilter of_every(Eigen::Index step) const;
  Eigen::Index first_of(Eigen::Index step) const;

 private:
  ParallelFilter();
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace torquescope
