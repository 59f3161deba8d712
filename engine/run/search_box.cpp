#include "engine/run/search_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace torquescope {

namespace {

Problem not_a_range(Section const& section, Setting const& setting) {
  Problem problem;
  problem.what = fmt::format("{} = {} is not a range", setting.key, to_text(setting.value));
  problem.place = setting.value_place;
  problem.key = section.name + "." + setting.key;
  problem.help = fmt::format("write two finite numbers, low and high: {} = [-1.0, 1.0]", setting.key);
  return problem;
}

}  // namespace

Bounds read_search_box(std::vector<std::string> const& parameter_names, Section const* bounds,
                       std::vector<Problem>& problems) {
  std::size_t const n = parameter_names.size();
  Bounds box{std::vector<double>(n, -1.0), std::vector<double>(n, 1.0)};
  if (!bounds) return box;
  std::vector<std::string> known = parameter_names;
  known.insert(known.begin(), "every");

  // "every" first, wherever it was written: a parameter's own range overrides it
  for (bool const for_every : {true, false}) {
    for (auto const& setting : bounds->settings) {
      if ((setting.key == "every") != for_every) continue;
      auto const parameter = std::find(parameter_names.begin(), parameter_names.end(), setting.key);
      if (!for_every && parameter == parameter_names.end()) {
        problems.push_back(unknown_key(*bounds, setting, known));
        continue;
      }
      auto const value = converted(setting.value, std::vector<double>{});
      auto const* range = value ? std::get_if<std::vector<double>>(&*value) : nullptr;
      bool const sound = range && range->size() == 2 && std::isfinite((*range)[0]) && std::isfinite((*range)[1]) &&
                         (*range)[0] < (*range)[1];
      if (!sound) {
        problems.push_back(not_a_range(*bounds, setting));
        continue;
      }
      for (std::size_t i = 0; i < n; ++i) {
        if (!for_every && parameter_names[i] != setting.key) continue;
        box.lower[i] = (*range)[0];
        box.upper[i] = (*range)[1];
      }
    }
  }
  return box;
}

}  // namespace torquescope
