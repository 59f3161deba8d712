#pragma once
// Sum of squared (or Huber) residuals of a block of candidates over a packed recording: the inner loop of every search.
//
// Equation   e_i = tau_i - sum_r phi_ir v_mr;  residual_energy  energy_m = sum_i e_i^2
//            huber_energy     energy_m = sum_i rho(e_i),  rho(e) = e^2 if |e| <= delta, else delta (2 |e| - delta)
// Shapes     candidates: n_members rows of n_regressors numbers, `leading_dimension` apart; energy: n_members
// Units      energy in (unit of tau)^2; delta in the unit of tau; delta = infinity gives residual_energy, bit for bit
// Bits       the same on every instruction set, grouping of members and number of threads: e by r = 0, 1, ...; lane l
//            sums samples l, l+8, ... of a block of 2048 by FMA; lanes ((0+4)+(2+6)) + ((1+5)+(3+7)); blocks by
//            PairwiseTree
// Error      at most ((1+g(R))^2 (1+g(D)) - 1) sum_i (|tau_i| + sum_r |phi_ir v_mr|)^2, g(k) = k u / (1 - k u), u =
//            2^-53, D = 259 + ceil(log2(number of blocks)), two more for Huber. A NaN or infinite parameter spoils its
//            own member
// Threads    any number on the same tiles, each with its own workspace; does not allocate
// Source     register tile: Goto, van de Geijn, ACM TOMS 34(3), 2008, doi:10.1145/1356052.1356053; squares are summed
//            in registers, phi v is never stored

#include <cstddef>

#include "kernels/sample_tiles.hpp"

namespace torquescope::kernels {

// candidates that share one pass over a tile; parameters are packed as [group][r][group_members]
inline constexpr std::size_t group_members = 6;

struct Candidates {
  double const* data = nullptr;  // data[member * leading_dimension + r]
  std::size_t n_members = 0;
  std::size_t leading_dimension = 0;  // >= n_regressors
};

// doubles of the packed parameters: whole groups
std::size_t packed_parameters_size(std::size_t n_members, std::size_t n_regressors);

// doubles of workspace for a recording of n_samples x n_regressors: packed parameters, lanes, partial sums
std::size_t energy_workspace_size(std::size_t n_samples, std::size_t n_regressors, std::size_t n_members);

void residual_energy(SampleTiles const& tiles, Candidates const& candidates, double* energy, double* workspace);

// delta > 0, may be infinite
void huber_energy(SampleTiles const& tiles, Candidates const& candidates, double delta, double* energy,
                  double* workspace);

}  // namespace torquescope::kernels
