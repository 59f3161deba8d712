#pragma once
// From the clipped output sets to one number, three ways.
//
// Equation   mu(y) = max_k min(level_k, fg(y, sigma, mean_k)), y in [0, top]
//   centroid           int y mu dy / int mu dy by the trapezoidal rule on equally spaced points; portable arithmetic
//                      only, so the same bits everywhere. 1001 points: error below 2e-6 of the closed form
//   centroid_closed    the same integrals piece by piece with erf; libm's last bit may differ between machines
//   weighted_average   sum_k level_k mean_k / sum_k level_k: the height method over the three clipped sets (not over
//                      the nine rules). Uses nearly the whole range of the means, which a centroid of wide clipped sets
//                      cannot; takes no notice of the universe
// Requires   some level > 0
// Threads    const objects, any number of threads

#include <cstddef>
#include <string>
#include <vector>

#include "engine/fit/optim/fuzzy_variable.hpp"

namespace torquescope {

enum class Defuzzification { centroid, centroid_closed, weighted_average };

// in the order of the enum
std::vector<std::string> const& defuzzification_words();

double closed_centroid(FuzzyVariable const& output, SetLevels const& levels);
double weighted_average(FuzzyVariable const& output, SetLevels const& levels);

// keeps the three membership curves on the grid: a centroid then costs no exponential
class GridCentroid {
 public:
  GridCentroid(FuzzyVariable const& output, std::size_t n_points);
  double operator()(SetLevels const& levels) const;

 private:
  struct Point {
    double y;
    double weight;  // trapezoidal: 1/2 at both ends
    SetLevels memberships;
  };
  std::vector<Point> points_;
};

}  // namespace torquescope
