#include "engine/simulate/joint_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace torquescope {

namespace {

// as it would have been written for one joint: whole numbers stay whole
OptionValue one_number(double value) {
  bool const is_whole = value == std::floor(value) && std::abs(value) < 9e15;
  return is_whole ? OptionValue(static_cast<std::int64_t>(value)) : OptionValue(value);
}

}  // namespace

std::vector<Section> sections_of_joints(Section const& section, std::size_t joints,
                                        std::function<bool(std::string const& key)> const& takes_list,
                                        std::vector<Problem>& problems) {
  std::vector<Section> each(joints, {section.name, section.place, {}});
  for (auto const& setting : section.settings) {
    auto const* list = std::get_if<std::vector<double>>(&setting.value);
    bool const is_shared = list == nullptr || takes_list(setting.key);
    if (!is_shared && list->size() != joints) {
      problems.push_back(
          problem_at(section, setting.key,
                     fmt::format("{} holds {} numbers, but the arm has {} joints", setting.key, list->size(), joints),
                     "write one number for each joint, or one for all of them"));
      continue;
    }
    for (std::size_t j = 0; j < joints; ++j) {
      each[j].settings.push_back(setting);
      if (!is_shared) each[j].settings.back().value = one_number((*list)[j]);
    }
  }
  return each;
}

std::function<bool(std::string const&)> list_keys(std::vector<OptionDescription> const& options) {
  std::vector<std::string> keys;
  for (auto const& option : options)
    if (option.type == type_name(std::vector<double>{})) keys.push_back(option.key);
  return [keys](std::string const& key) { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
}

void append_new(std::vector<Problem> const& found, std::vector<Problem>& problems) {
  for (auto const& one : found) {
    bool const is_known = std::any_of(problems.begin(), problems.end(), [&](Problem const& other) {
      return other.what == one.what && other.key == one.key && other.place.line == one.place.line;
    });
    if (!is_known) problems.push_back(one);
  }
}

}  // namespace torquescope
