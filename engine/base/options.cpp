#include "engine/base/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/unknown_number.hpp"

namespace torquescope {

Setting const* Section::find(std::string_view key) const {
  for (auto const& setting : settings)
    if (setting.key == key) return &setting;
  return nullptr;
}

SourcePlace Section::where(std::string_view key) const {
  Setting const* setting = find(key);
  return setting ? setting->value_place : place;
}

Problem problem_at(Section const& section, std::string const& key, std::string what, std::string help) {
  Problem problem;
  problem.what = std::move(what);
  problem.place = section.where(key);
  problem.key = key.empty() ? section.name : section.name + "." + key;
  problem.help = std::move(help);
  return problem;
}

namespace {

struct TextOf {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(std::string const& value) const { return fmt::format("\"{}\"", value); }
  template <class Item>
  std::string operator()(std::vector<Item> const& values) const {
    std::string text = "[";
    for (std::size_t i = 0; i < values.size(); ++i) text += (i ? ", " : "") + (*this)(values[i]);
    return text + "]";
  }
  std::string operator()(std::map<std::string, std::string> const& values) const {
    std::string text = "{";
    for (auto const& [key, value] : values)
      text += fmt::format("{}{} = \"{}\"", text.size() > 1 ? ", " : "", key, value);
    return text + "}";
  }
};

}  // namespace

std::string to_text(OptionValue const& value) { return std::visit(TextOf{}, value); }

std::string default_text(OptionValue const& value) {
  auto const* const number = std::get_if<double>(&value);
  return number != nullptr && std::isnan(*number) ? "none" : to_text(value);
}

std::string type_name(OptionValue const& value) {
  static char const* const names[] = {"true or false",   "whole number",  "number",        "text",
                                      "list of numbers", "list of texts", "table of texts"};
  return names[value.index()];
}

std::optional<OptionValue> converted(OptionValue const& given, OptionValue const& wanted_type) {
  if (given.index() == wanted_type.index()) return given;
  bool const wants_double = std::holds_alternative<double>(wanted_type);
  bool const wants_numbers = std::holds_alternative<std::vector<double>>(wanted_type);
  bool const wants_texts = std::holds_alternative<std::vector<std::string>>(wanted_type);
  if (auto const* whole = std::get_if<std::int64_t>(&given)) {
    if (wants_double) return static_cast<double>(*whole);
    if (wants_numbers) return std::vector<double>{static_cast<double>(*whole)};
  }
  if (auto const* number = std::get_if<double>(&given)) {
    if (wants_numbers) return std::vector<double>{*number};
  }
  // one text where a list may stand: train = "a.csv"
  if (auto const* text = std::get_if<std::string>(&given)) {
    if (wants_texts) return std::vector<std::string>{*text};
    if (wants_numbers && *text == unknown_number) return std::vector<double>{std::nan("")};
  }
  // an empty list has no type of its own
  if (auto const* texts = std::get_if<std::vector<std::string>>(&given)) {
    auto const is_unknown = [](std::string const& text) { return text == unknown_number; };
    if (wants_numbers && std::all_of(texts->begin(), texts->end(), is_unknown))
      return std::vector<double>(texts->size(), std::nan(""));
  }
  return std::nullopt;
}

std::string range_text(double least, double most, std::vector<std::string> const& words) {
  if (words.size() == 1 && words.front() == unknown_number) return fmt::format("numbers, \"{}\"", unknown_number);
  if (!words.empty()) return fmt::format("{}", fmt::join(words, " | "));
  constexpr double largest = std::numeric_limits<double>::max();
  bool const any_least = least <= -largest, any_most = most >= largest;
  if (any_least && any_most) return "";
  if (any_most) return fmt::format("at least {}", least);
  if (any_least) return fmt::format("at most {}", most);
  return fmt::format("{} to {}", least, most);
}

std::optional<Problem> check_option(OptionValue const& value, std::string const& key, std::string const& unit,
                                    double least, double most, std::vector<std::string> const& words) {
  auto const outside = [&](double number) -> std::optional<Problem> {
    if (std::isfinite(number) && number >= least && number <= most) return std::nullopt;
    Problem problem;
    std::string const shown_unit = unit.empty() || unit == "1" ? "" : " " + unit;
    problem.what = std::isfinite(number) ? fmt::format("{} = {} is out of range", key, number)
                                         : fmt::format("{} = {} is not a finite number", key, number);
    problem.help = fmt::format("{} takes {}{}", key, range_text(least, most, words), shown_unit);
    if (std::isinf(least) && std::isinf(most)) problem.help = key + " takes a finite number";
    return problem;
  };
  auto const unlisted = [&](std::string const& word) -> std::optional<Problem> {
    if (words.empty() || std::find(words.begin(), words.end(), word) != words.end()) return std::nullopt;
    Problem problem;
    problem.what = fmt::format("{} = \"{}\" is not one of its words", key, word);
    problem.notes = {fmt::format("{} takes: {}", key, fmt::join(words, ", "))};
    std::string const close = closest_name(word, words);
    if (!close.empty()) problem.caret_note = fmt::format("did you mean \"{}\"?", close);
    problem.help = fmt::format("write {} = \"{}\"", key, close.empty() ? words.front() : close);
    return problem;
  };
  if (auto const* whole = std::get_if<std::int64_t>(&value)) return outside(static_cast<double>(*whole));
  if (auto const* number = std::get_if<double>(&value)) return outside(*number);
  if (auto const* word = std::get_if<std::string>(&value)) return unlisted(*word);
  if (auto const* numbers = std::get_if<std::vector<double>>(&value)) {
    bool const may_be_unknown = std::find(words.begin(), words.end(), unknown_number) != words.end();
    for (double number : *numbers)
      if (!(may_be_unknown && std::isnan(number)))
        if (auto problem = outside(number)) return problem;
  }
  if (auto const* texts = std::get_if<std::vector<std::string>>(&value)) {
    for (auto const& word : *texts)
      if (auto problem = unlisted(word)) return problem;
  }
  return std::nullopt;
}

Problem unknown_key(Section const& section, Setting const& setting, std::vector<std::string> const& known) {
  Problem problem;
  problem.what = fmt::format("unknown key \"{}\" in [{}]", setting.key, section.name);
  problem.place = setting.key_place;
  problem.key = section.name + "." + setting.key;
  std::string const close = closest_name(setting.key, known);
  if (!close.empty()) problem.caret_note = fmt::format("did you mean \"{}\"?", close);
  problem.help =
      fmt::format("[{}] takes: {}      (torquescope describe {})", section.name, fmt::join(known, ", "), section.name);
  return problem;
}

Problem retired_key(Section const& section, Setting const& setting, RetiredKey const& retired) {
  Problem problem;
  problem.what = fmt::format("key \"{}\" of [{}] is gone", setting.key, section.name);
  problem.place = setting.key_place;
  problem.key = section.name + "." + setting.key;
  problem.help = retired.help;
  return problem;
}

Problem wrong_type(Section const& section, Setting const& setting, OptionValue const& wanted) {
  Problem problem;
  problem.what = fmt::format("{} = {} is a {}", setting.key, to_text(setting.value), type_name(setting.value));
  problem.place = setting.value_place;
  problem.key = section.name + "." + setting.key;
  problem.help =
      fmt::format("{} takes a {}, for example {} = {}", setting.key, type_name(wanted), setting.key, to_text(wanted));
  return problem;
}

}  // namespace torquescope
