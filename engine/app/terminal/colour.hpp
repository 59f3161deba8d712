#pragma once
// Bold and three of the terminal's own colours, decided per stream; a colour never carries a meaning alone.
//
// Rule       --color always|never, then NO_COLOR (not empty: off), then CLICOLOR_FORCE (not empty, not 0: on),
//            then on a terminal whose TERM is not "dumb"
// Source     no-color.org, bixense.com/clicolors

#include <string>
#include <string_view>

namespace torquescope {

enum class ColourChoice { automatic, always, never };

struct ColourFacts {
  bool is_terminal = false;
  std::string no_color{}, clicolor_force{}, term{};  // environment variables; unset is empty
};

bool use_colour(ColourChoice choice, ColourFacts const& facts);
ColourFacts colour_facts(bool is_terminal);  // of this process

// words in colour, or the same words
class Ink {
 public:
  explicit Ink(bool on = false) : on_(on) {}
  bool on() const { return on_; }
  std::string bold(std::string_view words) const { return paint("1", words); }
  std::string error(std::string_view words) const { return paint("1;31", words); }
  std::string warning(std::string_view words) const { return paint("1;33", words); }
  std::string name(std::string_view words) const { return paint("36", words); }

 private:
  std::string paint(char const* code, std::string_view words) const;
  bool on_;
};

}  // namespace torquescope
