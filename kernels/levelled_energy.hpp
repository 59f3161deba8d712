#pragma once
// Residual energies of a recording whose samples are sorted by the values of some columns: Coulomb friction and offsets
// take a few values only, so over a run of tiles they are one number per candidate instead of a column.
//
// Equation   as residual_energy.hpp; e_i = (tau_i - c_m) - sum_r phi_ir v_mr over the varying columns r,
//            c_m = sum_k level_k v_mk over the constant ones: R - K + 2 operations per sample instead of R + 1
// Shapes     below; candidates: n_members rows of R = varying + constant columns
// Bits       the same on every instruction set, in any grouping of members, on any number of threads: c by k and then e
//            by r with one rounding each; each run of tiles cut into blocks of 2048 samples, summed as in
//            residual_energy.hpp; the energy of the rest, then the blocks run by run, by PairwiseTree. Sums are
//            taken in another order than residual_energy takes them: equal to rounding, not to the bit
// Error      the bound of residual_energy.hpp with g(R + 1) for g(R), and as many blocks as these runs make
// Threads    any number on the same tiles, each with its own workspace; does not allocate

#include <cstddef>

#include "kernels/residual_energy.hpp"
#include "kernels/sample_tiles.hpp"

namespace torquescope::kernels {

struct LevelledTiles {
  SampleTiles varying;                           // whole tiles of the varying columns, run after run
  SampleTiles rest;                              // all columns: samples that fill no whole tile of their run
  std::size_t n_runs = 0;                        //
  std::size_t const* run_end = nullptr;          // [run] number of tiles up to its end
  double const* level = nullptr;                 // [run][n_constant] value of each constant column
  std::size_t n_constant = 0;                    // K
  std::size_t const* constant_column = nullptr;  // [K] which parameter
  std::size_t const* varying_column = nullptr;   // [varying.n_regressors] which parameter
};

// doubles of workspace
std::size_t levelled_workspace_size(LevelledTiles const& tiles, std::size_t n_members);

void levelled_residual_energy(LevelledTiles const& tiles, Candidates const& candidates, double* energy,
                              double* workspace);

// delta > 0, may be infinite
void levelled_huber_energy(LevelledTiles const& tiles, Candidates const& candidates, double delta, double* energy,
                           double* workspace);

}  // namespace torquescope::kernels
