#pragma once
// What becomes of rows near reversals: left out, or kept with a weight.
//
// mask       reversal_mask.hpp
// weigh      each row counts by what replicates with drawn sticking laws show there; rests alone are left out
//            (replicates/reversal_weights.hpp)
// both       mask; where nothing is missing beside it, weigh: what is named there counts, and what nothing explains
//            where the other rows hide much. weigh from the beginning where the mask leaves too few rows
// Threads    free functions

#include <string>
#include <vector>

namespace torquescope {

enum class ReversalRows { mask, weigh, both };

std::vector<std::string> reversal_words();           // of a job file, in the order above
ReversalRows reversals_of(std::string const& word);  // word is one of them

}  // namespace torquescope
