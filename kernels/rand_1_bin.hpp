#pragma once
// DE/rand/1/bin trial vectors of a whole population at once, before anything is done about bounds.
//
// Equation   v = x_r1 + F (x_r2 - x_r3); u_j = v_j if b_j < CR or j = j_rand, else x_j
//            (engine/fit/optim/mutation.hpp and
//            crossover.hpp say how r1, r2, r3, j_rand and b_j come from the draws)
// Random     member i draws from the stream whose second counter word is streams.first_word_1 + i, in this order: r1,
//            r2, r3, j_rand, then b_j of each parameter
// Shapes     members, trials: n_members x dimension, row-major, apart; of the trials the rows of `targets` are written.
//            lower, upper: dimension; outside: targets.count, 1 for a trial with a parameter below lower, above upper
//            or NaN, else 0
// Bits       the same on every instruction set, equal to engine/fit/optim/trial_vector.hpp's one member at a time
// Range      4 <= n_members < 2^32; 1 <= dimension < 2^32
// Threads    any number; does not allocate

#include <cstddef>
#include <cstdint>

#include "kernels/philox.hpp"

namespace torquescope::kernels {

struct Rand1Bin {
  std::size_t n_members = 0;
  std::size_t dimension = 0;
  double const* members = nullptr;
  double const* lower = nullptr;
  double const* upper = nullptr;
  double F = 0.0;
  double CR = 0.0;
};

// members first .. first + count - 1; count >= 1
struct Targets {
  std::size_t first = 0;
  std::size_t count = 0;
};

void rand_1_bin_trials(Rand1Bin const& population, PhiloxStreams const& streams, Targets targets, double* trials,
                       std::uint8_t* outside);

}  // namespace torquescope::kernels
