#include "engine/app/shell/completion.hpp"

namespace torquescope {

std::vector<std::string> first_words(std::vector<CommandPage> const& pages) {
  std::vector<std::string> words;
  for (auto const& page : pages) words.push_back(page.name);
  words.emplace_back("help");
  return words;
}

std::string short_title(CommandPage const& page) {
  std::size_t const end = page.title.find(". ");
  if (end != std::string::npos) return page.title.substr(0, end);
  bool const has_stop = page.title.ends_with(".");
  return has_stop ? page.title.substr(0, page.title.size() - 1) : page.title;
}

}  // namespace torquescope
