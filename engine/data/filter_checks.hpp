#pragma once
// What a recording allows of the options in [filter].
//
// Errors     Error 78: a cut-off at or above half the sampling rate, decimate_to_hz that divides the rate into no whole
//            number, a parallel cut-off above half the kept rate, a cut-off above half the rate of a
//            slow source; 65: the recording is shorter than the filter

#include <Eigen/Core>

#include "engine/data/motion.hpp"

namespace torquescope {

// a cut-off that is advised is no higher
inline constexpr double highest_share_of_rate = 1.0 / 5;

// parallel_cutoff_hz as written, or 0.4 * decimate_to_hz, or 0 for none
double parallel_cutoff_of(FilterOptions const& options);
// where the torque's band ends: without a parallel filter a little below half the rate
double torque_band_of(FilterOptions const& options, double rate_hz);

void check_cutoff(char const* key, double cutoff_hz, double rate_hz, Section const& section);
// cut-offs above half the rate at which a slow source renews the channel that they smooth
void check_source_rates(FilterOptions const& options, RowFacts const& rows, Section const& section);
void check_length(FilterOptions const& options, Eigen::Index n_samples, double rate_hz);
// every how manieth sample is kept
Eigen::Index decimation_factor(FilterOptions const& options, double rate_hz, Section const& section);
// samples dropped at each end
Eigen::Index edge_samples(FilterOptions const& options, double rate_hz);

}  // namespace torquescope
