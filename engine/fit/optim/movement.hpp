#pragma once
// How far a population moved in one generation: the two signals of FADE. They measure movement, not diversity.
//
// Equation   PC = sqrt(1/NP sum_i sum_j (x_ij - x_ij')^2),  FC = sqrt(1/NP sum_i (f_i - f_i')^2)        (seed eq. 8)
//            ' is the generation before, slot i with slot i, after selection. The seed prints x in FC; f is meant.
//   raw        as printed: depends on the units of x and on the scale of f
//   relative   x in box widths, f in standard deviations of the fitness of both generations together. No scale or shift
//              of f or of any x matters (scaled by powers of two: the same bits); FC is 0 .. 2
//   spread     f as relative; x likewise, each parameter in standard deviations of both generations together, root mean
//              square over the parameters: PC is 0 .. 2 too, and does not fade as the population narrows
//            Members that had no finite fitness before or after have no fitness change: they count 0 in FC.
// Shapes     members x dimension; fitness: one number per member

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/fit/optim/objective.hpp"
#include "engine/fit/optim/population.hpp"

namespace torquescope {

enum class MovementNorm { raw, relative, spread };

// in the order of the enum
std::vector<std::string> const& movement_norm_words();

struct Movement {
  double PC = 0.0;
  double FC = 0.0;
};

// winners: the members whose trials won, ascending; the others are the same before and after, and add exactly 0
Movement movement_between(Population const& before, Population const& after, std::span<std::size_t const> winners,
                          Bounds const& bounds, MovementNorm norm);

}  // namespace torquescope
