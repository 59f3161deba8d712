// NLopt's controlled random search: the same number of evaluations, another method (it ends at the optimum).

#include <nlopt.h>

#include <stdexcept>

#include "bench/peers/fused_error.hpp"

namespace peers {

double nlopt_crs2(Problem const& problem, unsigned seed) {
  auto const fitness = [](unsigned, double const* v, double*, void* data) {
    return fused_error(*static_cast<Problem const*>(data), v);
  };
  nlopt_srand(seed);
  nlopt_opt const search = nlopt_create(NLOPT_GN_CRS2_LM, static_cast<unsigned>(problem.R));
  // NLopt takes a pointer without const and only hands it back
  nlopt_set_min_objective(search, fitness, const_cast<Problem*>(&problem));
  nlopt_set_lower_bounds1(search, -1.0);
  nlopt_set_upper_bounds1(search, 1.0);
  nlopt_set_population(search, n_members);
  nlopt_set_maxeval(search, static_cast<int>(n_evaluations));
  std::vector<double> v(problem.R, 0.0);
  double least = 0.0;
  nlopt_result const result = nlopt_optimize(search, v.data(), &least);
  nlopt_destroy(search);
  if (result < 0) throw std::runtime_error("NLopt failed");
  return least;
}

}  // namespace peers
