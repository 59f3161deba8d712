#pragma once
// Words of columns that are written as one: "ides", "actpos", "Motorstrom", "Drehmomentistwert", "指令位置".
//
// Rule       a quantity beside whether it was commanded or measured; or known words of three letters and more that
//            leave nothing over. Of two quantities the last one counts: "Winkelgeschwindigkeit" is a speed
//            Of scripts without spaces what is known counts, and the rest says nothing
// Threads    functions of their arguments

#include <string>
#include <vector>

#include "engine/data/column_word.hpp"

namespace torquescope {

// `word` as column_word() takes it; nothing when it is no such compound. Without what says nothing
std::vector<ColumnWord> compound_word(std::string const& word);

}  // namespace torquescope
