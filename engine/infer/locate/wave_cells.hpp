#pragma once
// The cells of a spectrum: which waves of a grid lie in which of them, and what a map shows of them.
//
// Cells      54 from the lowest to the highest wave; each is wider than the one before by the same factor, but none
//            narrower than the distance of two waves: low frequencies and orders are read as finely as the recording
//            tells them apart, high ones in proportion. Fewer waves than cells: equal widths, some cells are empty
// Amplitude  rms over the waves of a cell of sqrt(2 energy / rows), that of a sine with this energy
// Window     a third of an octave, or the main lobe of one wave where that is wider; each begins a quarter of its width
//            after the one before: what the share of a spectrum is taken from
// Threads    free functions

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/infer/locate/wave_spectrum.hpp"

namespace torquescope {

// in the unit of the axis
std::vector<double> wave_edges(WaveGrid const& grid);

// waves with from <= wave < to, the last cell including its end
std::vector<WaveBand> waves_in(WaveGrid const& grid, std::span<double const> edges);

std::vector<WaveBand> third_octaves(WaveGrid const& grid);

// energies: bands x (1 + M) of band_energies(); NaN in a band without waves
Eigen::MatrixXd wave_amplitudes(WaveGrid const& grid, std::vector<WaveBand> const& bands,
                                Eigen::MatrixXd const& energies);

}  // namespace torquescope
