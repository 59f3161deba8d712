#include "engine/experiment/job_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace torquescope {

std::vector<std::string> const& known_sections() {
  static std::vector<std::string> const names{"experiment",
                                              "recording",
                                              "recordings",
                                              "known",
                                              "filter",
                                              "model",
                                              "model.joint_1",
                                              "model.bounds",
                                              "model.given",
                                              "model.effects",
                                              "loop",
                                              "estimator",
                                              "simulate",
                                              "simulate.plant",
                                              "simulate.reference",
                                              "simulate.controller",
                                              "simulate.encoder",
                                              "simulate.noise",
                                              "simulate.effects",
                                              "excite",
                                              "diagnose",
                                              "diagnose.levels",
                                              "output"};
  return names;
}

std::optional<std::size_t> joint_of_section(std::string const& name) {
  std::string const before = "model.joint_";
  if (!name.starts_with(before)) return {};
  std::size_t number = 0;
  char const* const end = name.data() + name.size();
  auto const read = std::from_chars(name.data() + before.size(), end, number);
  if (read.ec != std::errc() || read.ptr != end) return {};
  return number;
}

void check_section_names(Job const& job, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < job.sections.size(); ++i) {
    Section const& section = job.sections[i];
    bool known = joint_of_section(section.name).has_value();
    for (auto const& name : known_sections()) known = known || name == section.name;
    if (known) continue;
    Problem problem;
    problem.what = fmt::format("unknown section [{}]", section.name);
    problem.place = section.place;
    problem.key = section.name;
    std::string const close = closest_name(section.name, known_sections());
    if (!close.empty()) problem.caret_note = fmt::format("did you mean [{}]?", close);
    problem.help = "sections: " + fmt::format("{}", fmt::join(known_sections(), ", "));
    problems.push_back(problem);
  }
}

Section section_or_empty(Job const& job, std::string const& name) {
  if (Section const* section = job.find(name)) return *section;
  return Section{name, SourcePlace{job.path.string(), 0, 0, 0, ""}, {}};
}

bool is_a_name(std::string const& text) {
  return text != "." && text != ".." && std::none_of(text.begin(), text.end(), [](unsigned char letter) {
           return letter == '/' || letter < ' ' || letter == 127;
         });
}

}  // namespace torquescope
