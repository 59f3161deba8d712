#pragma once
// Option tables: each option stands once (key, member, unit, range, meaning); reading, checks, help and stored
// attributes all come from that line.
//
// Use        OptionTable<FadeOptions> const& FadeOptions::table();
//            {"cr_start", &FadeOptions::cr_start, "1", 0.0, 1.0, "crossover rate before adaptation"}
// Members    bool, std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>,
//            std::map<std::string, std::string>; a choice is a std::string option with its allowed words
// Errors     apply() collects Problems (exit code 78): unknown key with a suggestion, wrong type, out of range
// Threads    tables are immutable; apply() writes only its arguments

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/base/error.hpp"

namespace torquescope {

using OptionValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>,
                                 std::map<std::string, std::string>>;

// one "key = value" of a job file, with its place there
struct Setting {
  std::string key;
  OptionValue value;
  SourcePlace key_place{};
  SourcePlace value_place{};
};

// one [table] of a job file: settings in the order they were written
struct Section {
  std::string name;  // "filter", "estimator"
  SourcePlace place{};
  std::vector<Setting> settings;

  Setting const* find(std::string_view key) const;
  // the value's place if the key was written, else the section's
  SourcePlace where(std::string_view key) const;
};

// a Problem (exit code 78) at a key of a section: where it was written, or where the section begins
Problem problem_at(Section const& section, std::string const& key, std::string what, std::string help);

// what `torquescope describe` prints
struct OptionDescription {
  std::string key, type, unit, range, default_value, meaning;
};

std::string to_text(OptionValue const& value);       // as it would stand in a job file
std::string default_text(OptionValue const& value);  // the same; "none" of a number that is none unless it is written
std::string type_name(OptionValue const& value);     // "number", "text", "list of texts"
// converts what TOML wrote to what the member wants (integer -> double); nothing when it does not fit
std::optional<OptionValue> converted(OptionValue const& given, OptionValue const& wanted_type);

template <class Options>
struct Option {
  using Member = std::variant<bool Options::*, std::int64_t Options::*, double Options::*, std::string Options::*,
                              std::vector<double> Options::*, std::vector<std::string> Options::*,
                              std::map<std::string, std::string> Options::*>;
  // a number (or a list of numbers) with its range, both ends included
  Option(std::string key_, Member member_, std::string unit_, double least_, double most_, std::string meaning_)
      : key(std::move(key_)),
        member(member_),
        unit(std::move(unit_)),
        least(least_),
        most(most_),
        meaning(std::move(meaning_)) {}
  // anything without a range
  Option(std::string key_, Member member_, std::string meaning_)
      : key(std::move(key_)), member(member_), meaning(std::move(meaning_)) {}
  // a word out of several
  Option(std::string key_, Member member_, std::vector<std::string> words_, std::string meaning_)
      : key(std::move(key_)), member(member_), words(std::move(words_)), meaning(std::move(meaning_)) {}

  // the only readers and writers of members. Not inlined: GCC 12 follows every alternative of the variant into the
  // object, and takes a text read from a struct of two numbers for one out of bounds
  [[gnu::noinline]] OptionValue get(Options const& options) const {
    return std::visit([&](auto one) { return OptionValue(options.*one); }, member);
  }
  // Requires   a value of the member's type
  [[gnu::noinline]] void set(Options& options, OptionValue const& value) const {
    std::visit([&](auto one) { options.*one = std::get<std::decay_t<decltype(options.*one)>>(value); }, member);
  }

  std::string key;
  Member member;
  std::string unit{};
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  std::vector<std::string> words{};
  std::string meaning;
};

// the untyped half of apply(): checks one converted value; a Problem without place when it does not hold
std::optional<Problem> check_option(OptionValue const& value, std::string const& full_key, std::string const& unit,
                                    double least, double most, std::vector<std::string> const& words);
Problem unknown_key(Section const& section, Setting const& setting, std::vector<std::string> const& known);
Problem wrong_type(Section const& section, Setting const& setting, OptionValue const& wanted);
std::string range_text(double least, double most, std::vector<std::string> const& words);

// a key that programs before this one had, and what to do about it
struct RetiredKey {
  std::string key, help;
};
Problem retired_key(Section const& section, Setting const& setting, RetiredKey const& retired);

template <class Options>
class OptionTable {
 public:
  OptionTable(std::string section, std::string meaning, std::vector<Option<Options>> options,
              std::vector<RetiredKey> retired = {})
      : section_(std::move(section)),
        meaning_(std::move(meaning)),
        options_(std::move(options)),
        retired_(std::move(retired)) {}

  std::string const& section() const { return section_; }
  std::string const& meaning() const { return meaning_; }

  // writes every setting of the section into `options`; `ignored` keys belong to somebody else ("name" of an estimator)
  void apply(Section const& section, Options& options, std::vector<Problem>& problems,
             std::vector<std::string> const& ignored = {}) const;
  std::vector<OptionDescription> describe() const;
  // (key, value) of every option: what the result file stores as attributes
  std::vector<std::pair<std::string, OptionValue>> values(Options const& options) const;

 private:
  std::string section_;
  std::string meaning_;
  std::vector<Option<Options>> options_;
  std::vector<RetiredKey> retired_;
};

template <class Options>
void OptionTable<Options>::apply(Section const& section, Options& options, std::vector<Problem>& problems,
                                 std::vector<std::string> const& ignored) const {
  std::vector<std::string> known = ignored;
  for (auto const& option : options_) known.push_back(option.key);
  for (auto const& setting : section.settings) {
    bool is_known = false;
    for (auto const& name : ignored) is_known = is_known || name == setting.key;
    for (auto const& option : options_) {
      if (option.key != setting.key) continue;
      is_known = true;
      auto const wanted = option.get(options);
      auto const value = converted(setting.value, wanted);
      if (!value) {
        problems.push_back(wrong_type(section, setting, wanted));
        continue;
      }
      auto problem = check_option(*value, setting.key, option.unit, option.least, option.most, option.words);
      if (problem) {
        problem->place = setting.value_place;
        problem->key = section.name + "." + setting.key;
        problems.push_back(std::move(*problem));
        continue;
      }
      option.set(options, *value);
    }
    for (auto const& one : retired_) {
      if (one.key != setting.key) continue;
      is_known = true;
      problems.push_back(retired_key(section, setting, one));
    }
    if (!is_known) problems.push_back(unknown_key(section, setting, known));
  }
}

template <class Options>
std::vector<OptionDescription> OptionTable<Options>::describe() const {
  Options const defaults{};
  std::vector<OptionDescription> descriptions;
  for (auto const& option : options_) {
    auto const value = option.get(defaults);
    descriptions.push_back({option.key, type_name(value), option.unit,
                            range_text(option.least, option.most, option.words), default_text(value), option.meaning});
  }
  return descriptions;
}

template <class Options>
std::vector<std::pair<std::string, OptionValue>> OptionTable<Options>::values(Options const& options) const {
  std::vector<std::pair<std::string, OptionValue>> result;
  for (auto const& option : options_) result.emplace_back(option.key, option.get(options));
  return result;
}

}  // namespace torquescope
