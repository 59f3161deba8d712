// pagmo2's differential evolution; ftol = xtol = 0, so that it makes as many evaluations as everybody else.

#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/types.hpp>

#include "bench/peers/fused_error.hpp"

namespace peers {
namespace {

struct PagmoProblem {
  Problem const* problem = nullptr;
  pagmo::vector_double fitness(pagmo::vector_double const& v) const { return {fused_error(*problem, v.data())}; }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(4, -1.0), pagmo::vector_double(4, 1.0)};
  }
};

}  // namespace

double pagmo_de(Problem const& problem, unsigned seed) {
  constexpr unsigned rand_1_bin = 7;
  constexpr double never_stop = 0.0;
  pagmo::population const start(pagmo::problem{PagmoProblem{&problem}}, n_members, seed);
  pagmo::algorithm const de(pagmo::de(n_generations, F, CR, rand_1_bin, never_stop, never_stop, seed));
  return de.evolve(start).champion_f()[0];
}

}  // namespace peers
