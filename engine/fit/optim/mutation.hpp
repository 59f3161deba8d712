#pragma once
// Mutations of differential evolution. DE/rand/1: a random member plus a scaled difference of two others.
//
// Equation   v = x_r1 + F (x_r2 - x_r3); r1, r2, r3 and the target i all different         (seed eq. 5)
// Random     three draws, without rejection: every ordered triple has the same probability
// Requires   at least four members
// Speed      no branch depends on a draw: inline, for the trial vector's loop
// Source     Storn, Price: Differential evolution, J. Global Optimization 11 (1997)

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/base/matrix_view.hpp"
#include "engine/base/random_stream.hpp"

namespace torquescope {

// std::min and std::max become branches where the compiler sees that a comparison was made before
inline std::size_t smaller(std::size_t a, std::size_t b) { return b ^ ((a ^ b) & -std::size_t{a < b}); }
inline std::size_t larger(std::size_t a, std::size_t b) { return a ^ ((a ^ b) & -std::size_t{a < b}); }

// a member that is none of `taken`, which ascend: drawn among those that are left, then moved past the taken ones
template <std::size_t n_taken>
std::size_t pick_another(RandomStream& random, std::size_t n_members, std::array<std::size_t, n_taken> const& taken) {
  std::size_t index = random.below(static_cast<std::uint32_t>(n_members - n_taken));
  for (std::size_t const member : taken) index += index >= member ? 1 : 0;
  return index;
}

inline std::array<std::size_t, 3> pick_three_others(RandomStream& random, std::size_t n_members, std::size_t target) {
  TORQUESCOPE_EXPECT(n_members >= 4 && target < n_members);
  std::size_t const r1 = pick_another<1>(random, n_members, {target});
  std::size_t const low = smaller(target, r1), high = larger(target, r1);
  std::size_t const r2 = pick_another<2>(random, n_members, {low, high});
  std::size_t const middle = larger(low, smaller(high, r2));
  std::size_t const r3 = pick_another<3>(random, n_members, {smaller(low, r2), middle, larger(high, r2)});
  return {r1, r2, r3};
}

inline void mutate_rand_1(MatrixView<double const> members, std::array<std::size_t, 3> const& picked, double F,
                          std::span<double> mutant) {
  TORQUESCOPE_EXPECT(mutant.size() == members.columns());
  auto const base = members.row(picked[0]);
  auto const plus = members.row(picked[1]);
  auto const minus = members.row(picked[2]);
  for (std::size_t j = 0; j < mutant.size(); ++j) mutant[j] = base[j] + F * (plus[j] - minus[j]);
}

// v = x + F (x_best - x) + F (x_plus - x_minus)                          (JADE's current-to-pbest/1 where best is one
// of many)
inline void mutate_current_to_best_1(std::span<double const> target, std::span<double const> best,
                                     std::span<double const> plus, std::span<double const> minus, double F,
                                     std::span<double> mutant) {
  for (std::size_t j = 0; j < mutant.size(); ++j)
    mutant[j] = target[j] + F * (best[j] - target[j]) + F * (plus[j] - minus[j]);
}

}  // namespace torquescope
