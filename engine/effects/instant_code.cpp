#include "engine/effects/instant_code.hpp"

#include <algorithm>
#include <cctype>

namespace torquescope {
namespace {

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// made(word) in place of each word, numbers among them; what is between words stays
template <class Make>
std::string each_word(std::string const& code, Make&& made) {
  std::string text;
  for (std::size_t at = 0; at < code.size();) {
    std::size_t end = at;
    while (end < code.size() && is_letter(code[end])) ++end;
    text += end > at ? made(code.substr(at, end - at)) : std::string(1, code[at]);
    at = std::max(end, at + 1);
  }
  return text;
}

bool is_of_the_clock(Effect const& effect) {
  auto const& axes = effect.signature();
  return std::find(axes.begin(), axes.end(), SignatureAxis::time) != axes.end();
}

}  // namespace

bool has_word(std::string const& code, std::string const& word) {
  bool found = false;
  each_word(code, [&](std::string const& one) {
    found = found || one == word;
    return one;
  });
  return found;
}

std::string with_words(std::string const& code, std::map<std::string, std::string> const& words) {
  return each_word(code, [&](std::string const& one) {
    auto const found = words.find(one);
    return found == words.end() ? one : found->second;
  });
}

std::string why_no_code(Effect const& effect) {
  if (!effect.code().empty()) return "";
  if (effect.is_of_whole_arm()) return "acts on several joints of the arm at once";
  if (effect.is_given()) return "follows the motion of other joints";
  if (effect.acts_on() != ActsOn::joint) return "is of a recorded channel, not of the joint";
  if (effect.has_memory()) return "depends on the motion before this instant";
  if (is_of_the_clock(effect)) return "depends on the time in the recording";
  if (effect.needs_baseline()) return "depends on torque or levels of the fitted model";
  return "depends on the travel that was recorded";
}

}  // namespace torquescope
