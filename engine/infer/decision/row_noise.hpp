#pragma once
// Noise of rows, drawn with the spectrum that a residual has: smoothed over two octaves, so that no wave of it becomes
// a wave of every replicate.
//
// Equation   power per frequency of the residual, as means over two octaves; less what replicates without noise have;
//            between the middles of two of them straight in both logarithms
// Shapes     rows of one recording; positions that were left out count as if the others followed each other
// Random     addressed by (seed, replicate)
// Threads    pure functions
// Source     surrogates with a given spectrum: Theiler et al. 1992, doi:10.1016/0167-2789(92)90102-S; smoothed
//            periodograms: Priestley 1981, Spectral Analysis and Time Series, section 6.2, ISBN 978-0-12-564922-3

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace torquescope {

// of a signal: power of each band, the lowest first; the sum over all waves is the mean square
struct OctavePowers {
  Eigen::VectorXd per_wave{};  // mean power of a wave there
};

OctavePowers octave_powers(Eigen::VectorXd const& signal);
// not below zero
OctavePowers less(OctavePowers const& whole, OctavePowers const& part);
OctavePowers mean_of(std::vector<OctavePowers> const& all);

struct NoiseAddress {
  std::uint64_t seed = 0;
  std::uint32_t step = 0, replicate = 0;
};
// n rows
Eigen::VectorXd drawn_noise(OctavePowers const& powers, Eigen::Index n, NoiseAddress const& address);

}  // namespace torquescope
