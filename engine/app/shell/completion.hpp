#pragma once
// Scripts that complete commands, options, words and files in a shell: engine/app/shell/bash.cpp, zsh.cpp, fish.cpp.
//
// Texts      made of the pages alone; the same pages give the same bytes

#include <string>
#include <vector>

#include "engine/app/shell/command_page.hpp"

namespace torquescope {

std::string bash_completion(std::vector<CommandPage> const& pages);
std::string zsh_completion(std::vector<CommandPage> const& pages);
std::string fish_completion(std::vector<CommandPage> const& pages);

struct Shell {
  char const* name;
  std::string (*completion)(std::vector<CommandPage> const&);
};
inline constexpr Shell shells[] = {{"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}};

// what stands behind "torquescope": commands, then "help"
std::vector<std::string> first_words(std::vector<CommandPage> const& pages);
// the first sentence of a title, without its full stop
std::string short_title(CommandPage const& page);

}  // namespace torquescope
