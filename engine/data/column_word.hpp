#pragma once
// What the words of a column's name say: which quantity it holds, whether it was commanded or measured.
//
// Weight     how sure the word is, 0 to 100: "torque" says more than "u"
// Threads    functions of their arguments

#include <optional>
#include <string_view>

namespace torquescope {

enum class WordKind {
  time,
  position,
  velocity,
  acceleration,
  torque,
  drive,      // what a motor makes torque of: current, voltage, pulse width
  commanded,  // "ref", "goal", "target"
  measured,   // "actual", "feedback"
  doubtful,   // "error", "limit", "temp": no plain channel
  raw,        // a register, as it came
  filler,     // part of a compound that says nothing by itself: "motor" of "Motorstrom"
};

struct ColumnWord {
  WordKind kind = WordKind::doubtful;
  int weight = 0;
};

inline bool is_quantity(WordKind kind) { return kind <= WordKind::drive; }

// `word` in lower case and without accents, a plural as its singular; nothing when it says nothing
std::optional<ColumnWord> column_word(std::string_view word);

}  // namespace torquescope
