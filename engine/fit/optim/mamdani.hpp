#pragma once
// A Mamdani system of two inputs and one output with the rule table of FADE.
//
// Inference  min for AND, min implication, max aggregation, then defuzzification.hpp
// Rules      nine: IF a is A AND b is B THEN output is max(A, B), with small < middle < big      (seed table 2)
//            The nine rules therefore clip three sets:
//              small   at min(a_S, b_S)
//              big     at the larger of min(a_B, any b) and min(any a, b_B)
//              middle  at the larger of what is left, without B
// Requires   inputs in their universes
// Threads    const object, any number of threads; does not allocate except with centroid_closed
// Source     Mamdani, Assilian: Int. J. Man-Machine Studies 7 (1975); rules: Liu, Lampinen: Soft Computing 9 (2005)

#include <array>
#include <cstddef>

#include "engine/fit/optim/defuzzification.hpp"
#include "engine/fit/optim/fuzzy_variable.hpp"

namespace torquescope {

// at which level the rules together clip each output set
SetLevels clip_levels(SetLevels const& first, SetLevels const& second);

class MamdaniSystem {
 public:
  MamdaniSystem(FuzzyVariable first, FuzzyVariable second, FuzzyVariable output, Defuzzification defuzzification,
                std::size_t centroid_points);

  double operator()(double first_level, double second_level) const;

  FuzzyVariable const& first() const { return first_; }
  FuzzyVariable const& second() const { return second_; }
  FuzzyVariable const& output() const { return output_; }

 private:
  FuzzyVariable first_;
  FuzzyVariable second_;
  FuzzyVariable output_;
  Defuzzification defuzzification_;
  GridCentroid grid_centroid_;
};

}  // namespace torquescope
