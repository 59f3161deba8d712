#include "engine/experiment/search_box.hpp"

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

Bounds default_box(Eigen::VectorXd const& values, Eigen::VectorXd const& errors) {
  constexpr double wide = 3.0;
  Bounds box;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    double const size = wide * (std::fabs(values[i]) + errors[i]);
    double const bound = size > 0.0 && std::isfinite(size) ? std::pow(10.0, std::ceil(std::log10(size))) : 1.0;
    box.lower.push_back(-bound);
    box.upper.push_back(bound);
  }
  return box;
}

std::string box_words(std::vector<std::string> const& parameter_names, Bounds const& box) {
  std::string text;
  for (std::size_t i = 0; i < parameter_names.size(); ++i)
    text += fmt::format("{}{} {:g} to {:g}", i ? ", " : "", parameter_names[i], box.lower[i], box.upper[i]);
  return text;
}

std::vector<std::string> on_bounds(std::vector<std::string> const& parameter_names, Bounds const& box,
                                   Eigen::VectorXd const& parameters) {
  constexpr double at = 1e-6;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < parameter_names.size(); ++i) {
    double const value = parameters[static_cast<Eigen::Index>(i)], reach = at * (box.upper[i] - box.lower[i]);
    if (value <= box.lower[i] + reach || value >= box.upper[i] - reach) names.push_back(parameter_names[i]);
  }
  return names;
}

}  // namespace torquescope
