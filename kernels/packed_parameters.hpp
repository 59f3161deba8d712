#pragma once
// Parameters of candidates as the energy kernels read them: [group][r][group_members], zero behind the last member;
// Real is double, or float for float_energy.hpp.
//
// Threads    free functions on the caller's numbers

#include <cstddef>

#include "kernels/residual_energy.hpp"

namespace torquescope::kernels {

inline std::size_t group_count(std::size_t n_members) { return (n_members + group_members - 1) / group_members; }

// column: [n_regressors] which parameter is taken as number r; nullptr for all in their order
template <class Real>
void pack_parameters(Candidates const& candidates, std::size_t const* column, std::size_t n_regressors, Real* packed) {
  for (std::size_t first = 0; first < candidates.n_members; first += group_members) {
    for (std::size_t r = 0; r < n_regressors; ++r) {
      std::size_t const from = column ? column[r] : r;
      for (std::size_t m = first; m < first + group_members; ++m)
        *packed++ = static_cast<Real>(
            m < candidates.n_members ? candidates.data[m * candidates.leading_dimension + from] : 0.0);
    }
  }
}

}  // namespace torquescope::kernels
