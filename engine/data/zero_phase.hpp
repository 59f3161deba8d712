#pragma once
// A filter run forwards, then backwards: no phase, the gain squared (a Butterworth cut-off becomes its -6 dB point).
//
// Edges      both ends are continued by their odd reflection (a ramp stays a ramp) over 3 (2 n_sections + 1) samples,
//            less 3 for an odd order; every section starts in the steady state of the first sample
// Requires   signal.size() > padding_of(sections); sections with gain 1 at f = 0
// Source     Gustafsson 1996, "Determining the initial states in forward-backward filtering"; equal to
//            scipy.signal.sosfiltfilt with its default padding

#include <Eigen/Core>
#include <vector>

#include "engine/data/butterworth.hpp"

namespace torquescope {

Eigen::Index padding_of(std::vector<FilterSection> const& sections);

Eigen::VectorXd zero_phase(std::vector<FilterSection> const& sections, Eigen::Ref<Eigen::VectorXd const> const& signal);

// samples of the result that are wanted: first, first + step, ...
struct KeptSamples {
  Eigen::Index first = 0, count = 0, step = 1;
};

// every column by itself, eight at a time; the bits are those of one at a time
Eigen::MatrixXd zero_phase_columns(std::vector<FilterSection> const& sections,
                                   Eigen::Ref<Eigen::MatrixXd const> const& signals);

Eigen::MatrixXd zero_phase_columns(std::vector<FilterSection> const& sections,
                                   Eigen::Ref<Eigen::MatrixXd const> const& signals, KeptSamples const& kept);
// every sample of every column, one block of columns after the other: nothing as large as the signals beside them
void zero_phase_in_place(std::vector<FilterSection> const& sections, Eigen::MatrixXd& signals);

}  // namespace torquescope
