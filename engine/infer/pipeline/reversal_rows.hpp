#pragma once
// What becomes of rows near reversals: left out, or kept with a weight.
//
// mask       reversal_mask.hpp
// weigh      each row counts by what replicates with drawn sticking laws show there; rests alone are left out
//            (replicates/reversal_weights.hpp)
// both       mask; weigh where it leaves too few rows to search
// Threads    free functions

#include <string>
#include <vector>

namespace torquescope {

enum class ReversalRows { mask, weigh, both };

std::vector<std::string> reversal_words();           // of a job file, in the order above
ReversalRows reversals_of(std::string const& word);  // word is one of them

}  // namespace torquescope
