#include "engine/app/terminal/colour.hpp"

#include <fmt/format.h>

#include "engine/app/terminal/environment.hpp"

namespace torquescope {

bool use_colour(ColourChoice choice, ColourFacts const& facts) {
  if (choice != ColourChoice::automatic) return choice == ColourChoice::always;
  if (!facts.no_color.empty()) return false;
  if (!facts.clicolor_force.empty() && facts.clicolor_force != "0") return true;
  return facts.is_terminal && facts.term != "dumb";
}

ColourFacts colour_facts(bool is_terminal) {
  return {is_terminal, environment("NO_COLOR"), environment("CLICOLOR_FORCE"), environment("TERM")};
}

std::string Ink::paint(char const* code, std::string_view words) const {
  return on_ && !words.empty() ? fmt::format("\x1b[{}m{}\x1b[0m", code, words) : std::string(words);
}

}  // namespace torquescope
