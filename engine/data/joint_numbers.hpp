#pragma once
// Joints that one channel of a file counts from 0 and another from 1: "q0..q5" beside "tau1..tau6".
//
// Rule       a family is columns that differ by their number alone, which runs without a gap. It is counted anew where
//            no family of positions has its numbers, and one of as many columns begins one earlier or later
// Threads    free function

#include <optional>
#include <vector>

#include "engine/data/column_suggestion.hpp"

namespace torquescope {

// two columns of one joint whose names have different numbers
struct NumberShift {
  std::string position, other;
};

// gives the columns of `channel` the numbers of the positions they belong to
std::optional<NumberShift> number_like(std::vector<LikelyColumn> const& positions, std::vector<LikelyColumn>& channel);

}  // namespace torquescope
