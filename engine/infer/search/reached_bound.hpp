#pragma once
// A fitted parameter at the end of what is plausible: the best law lies beyond it, so that it is none of the catalogue.
//
// Rule       a shape within rounding of a bound, or a linear parameter with a bound of its own kind (a number, a time)
// Spared     bounds that are laws or limits of physics themselves: 0 where a parameter cannot be negative, a bound that
//            stands for a law without the parameter, and those that the catalogue calls so (EffectParameter)
// Intervals  that touch a bound are no matter: only the estimate is asked
// Units      SI of the parameter
// Threads    free functions

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "engine/infer/search/candidate_columns.hpp"

namespace torquescope {

enum class BoundSide { lower, upper };

struct ReachedBound {
  std::size_t parameter = 0;  // of the effect: linear ones first
  BoundSide side = BoundSide::lower;
  double value = 0.0;
};

// the first parameter that stands at a bound, told by the numbers alone
std::optional<ReachedBound> reached_bound(Effect const& effect, std::span<double const> shape,
                                          Eigen::VectorXd const& linear, JointScales const& scales);

// "its presliding distance ends at the least it can be, 1.57e-05 rad"
std::string bound_words(Effect const& effect, ReachedBound const& bound, JointKind joint);

}  // namespace torquescope
