#pragma once
// The seed's job as the peers see it: regressor and torque of a single joint, a box, a budget; nothing of ours is
// linked.
//
// Equation   mse(v) = sum_t (tau_t - sum_r phi_tr v_r)^2 / n over the box -1 .. 1
// Shapes     phi: n x R, column-major; tau: n. File: n and R as uint64, phi, tau (bench/seed_job.py writes it)
// Errors     std::runtime_error when the file is not what it should be
// Threads    plain record, one thread

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace peers {

struct Problem {
  std::size_t n = 0, R = 0;
  std::vector<double> phi, tau;
  double const* column(std::size_t r) const { return phi.data() + r * n; }
};

Problem read_problem(std::string const& file);

inline constexpr unsigned n_members = 30;
inline constexpr unsigned n_generations = 100;  // after the initial population
inline constexpr unsigned n_evaluations = n_members * (n_generations + 1);
inline constexpr double F = 0.8;
inline constexpr double CR = 0.9;

// one search; the least MSE found
using Search = double (*)(Problem const& problem, unsigned seed);

double pagmo_de(Problem const& problem, unsigned seed);
double nlopt_crs2(Problem const& problem, unsigned seed);
double openblas_de(Problem const& problem, unsigned seed);
double eigen_de(Problem const& problem, unsigned seed);
double textbook_de(Problem const& problem, unsigned seed);

}  // namespace peers
