#include "engine/account/power_words.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/quantity_text.hpp"

namespace torquescope {

std::string power_sentence(DecisionAccount const& decision, std::string const& unit_position) {
  if (!std::isfinite(decision.smallest_named)) return "";
  std::string const of_turning =
      decision.sticking_length > 0.0
          ? fmt::format("; friction that turns round within {} would not, because it counts as the model's own",
                        quantity_text(decision.sticking_length, unit_position))
          : "";
  return fmt::format(
      "A torque of {} of the whole that the model's terms do not take up would most likely have been named{}.",
      percent_text(decision.smallest_named), of_turning);
}

}  // namespace torquescope
