#include "engine/workflows/drafts/column_remarks.hpp"

#include <fmt/format.h>

#include "engine/data/health/finding_text.hpp"

namespace torquescope {

std::string shift_words(NumberShift const& shift) {
  return fmt::format("joints are counted from different numbers: \"{}\" belongs to \"{}\"", shift.other,
                     shift.position);
}

std::string passed_over_words(ColumnGuess const& columns) {
  if (!columns.passes_over_others) return {};
  if (columns.joint == 2) return "the first that moves: joint 1 hardly moves, or no torque of it changes";
  return fmt::format("the first that moves: joints 1 to {} hardly move, or no torque of theirs changes",
                     columns.joint - 1);
}

std::string look_words(ColumnLook const& look) {
  auto const what = [&]() -> std::string {
    switch (look.look) {
      case Look::constant:
        return fmt::format("{:.4g} in every row", look.least);
      case Look::clock:
        return fmt::format("runs forwards from {:.6g} to {:.6g}, by {:.4g} a row: a clock or a counter", look.least,
                           look.most, look.step);
      case Look::two_values:
        return fmt::format("{:.4g} or {:.4g}: a switch", look.least, look.most);
      case Look::position:
        return fmt::format("{:.4g} to {:.4g}, smooth, by {:.2g} a row: as a position", look.least, look.most,
                           look.step);
      case Look::derivative:
        return fmt::format("{:.4g} to {:.4g}, goes with the derivative of \"{}\" (correlation {:.2f}): as a speed",
                           look.least, look.most, look.of, look.likeness);
      case Look::torque:
        return fmt::format(
            "{:.4g} to {:.4g}; acceleration, speed and its sign of \"{}\" explain {:.0f} %: as a torque or current",
            look.least, look.most, look.of, 100 * look.likeness);
      case Look::like_none:
        return fmt::format("{:.4g} to {:.4g}, by {:.2g} a row", look.least, look.most, look.step);
    }
    return {};
  };
  return fmt::format("\"{}\": {}", look.column, what());
}

std::string unused_reference_words(RecordingGuess const& guess) {
  if (guess.no_command) return sentence_of(*guess.no_command);
  auto const& reference = guess.columns.reference;
  bool const is_unused = guess.torque == TorqueColumn::required && !reference.column.empty();
  if (!is_unused || reference_serves(guess.columns)) return {};
  return reference.is_constant
             ? fmt::format("\"{}\" is not used as the reference: it is a constant ({:g}) and no command",
                           reference.column, reference.least)
             : fmt::format("\"{}\" is not used as the reference: its unit is not the position's", reference.column);
}

}  // namespace torquescope
