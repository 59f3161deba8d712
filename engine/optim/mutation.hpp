#pragma once
// DE/rand/1 mutation: a random member plus a scaled difference of two others.
//
// Equation   v = x_r1 + F (x_r2 - x_r3); r1, r2, r3 and the target i all different         (seed eq. 5)
// Random     three draws, without rejection: every ordered triple has the same probability
// Requires   at least four members
// Source     Storn, Price: Differential evolution, J. Global Optimization 11 (1997)

#include <array>
#include <cstddef>
#include <span>

#include "engine/base/matrix_view.hpp"
#include "engine/base/random_stream.hpp"

namespace torquescope {

std::array<std::size_t, 3> pick_three_others(RandomStream& random, std::size_t n_members, std::size_t target);

void mutate_rand_1(MatrixView<double const> members, std::array<std::size_t, 3> const& picked, double F,
                   std::span<double> mutant);

}  // namespace torquescope
