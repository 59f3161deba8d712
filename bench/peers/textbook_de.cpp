// DE with a plain loop over the samples of each candidate: what stands in textbooks.

#include "bench/peers/differential_evolution.hpp"

namespace peers {

double textbook_de(Problem const& problem, unsigned seed) {
  return differential_evolution(problem, seed, [&](double const* members, double* mse) {
    for (std::size_t m = 0; m < n_members; ++m) {
      double const* const v = members + m * problem.R;
      double sum = 0.0;
      for (std::size_t t = 0; t < problem.n; ++t) {
        double e = problem.tau[t];
        for (std::size_t r = 0; r < problem.R; ++r) e -= problem.column(r)[t] * v[r];
        sum += e * e;
      }
      mse[m] = sum / static_cast<double>(problem.n);
    }
  });
}

}  // namespace peers
