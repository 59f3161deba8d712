#include "engine/robot/xml_words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace torquescope {

namespace {

std::vector<std::string> split_words(std::string_view list) {
  std::vector<std::string> words;
  while (!list.empty()) {
    auto const end = std::min(list.find(' '), list.size());
    if (end > 0) words.emplace_back(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return words;
}

XmlWords const* words_of(std::span<XmlWords const> known, std::string const& parent, std::string const& element) {
  XmlWords const* found = nullptr;
  for (auto const& one : known) {
    if (one.element == element && found == nullptr) found = &one;
    if (one.element == parent + "/" + element) return &one;
  }
  return found;
}

bool is_of_others(std::string const& word) { return word.find(':') != std::string::npos || word == "xmlns"; }

std::string suggestion(std::string const& word, std::vector<std::string> const& candidates) {
  if (auto const close = closest_name(word, candidates); !close.empty())
    return fmt::format("did you mean \"{}\"?", close);
  return candidates.empty() ? "nothing is known there" : fmt::format("known there: {}", fmt::join(candidates, ", "));
}

class UnknownWords {
 public:
  explicit UnknownWords(std::span<XmlWords const> known) : known_(known) {}

  void look(XmlElement const& element, std::string const& parent) {
    auto const* const words = words_of(known_, parent, element.name);
    if (words == nullptr) return;
    auto const attributes = split_words(words->attributes);
    for (auto const& one : element.attributes)
      if (!is_of_others(one.name) && std::find(attributes.begin(), attributes.end(), one.name) == attributes.end())
        tell(element.place_of(one.name), fmt::format("attribute \"{}\" of <{}>", one.name, element.name),
             suggestion(one.name, attributes));
    if (words->children == "*") return;
    auto const children = split_words(words->children);
    for (auto const& child : element.children) {
      if (is_of_others(child.name)) continue;
      if (std::find(children.begin(), children.end(), child.name) != children.end())
        look(child, element.name);
      else
        tell(child.place(), fmt::format("<{}> in <{}>", child.name, element.name), suggestion(child.name, children));
    }
  }

  std::vector<std::string> sentences;

 private:
  void tell(SourcePlace const& place, std::string const& what, std::string const& hint) {
    sentences.push_back(fmt::format("{}: {} is unknown and was not read; {}", place_text(place), what, hint));
  }
  std::span<XmlWords const> known_;
};

}  // namespace

std::vector<std::string> unknown_words(XmlElement const& root, std::span<XmlWords const> known) {
  UnknownWords found(known);
  found.look(root, "");
  return std::move(found.sentences);
}

std::string place_text(SourcePlace const& place) { return fmt::format("{}:{}", place.file, place.line); }

}  // namespace torquescope
