#include "engine/run/job_sections.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace torquescope {

std::vector<std::string> const& known_sections() {
  static std::vector<std::string> const names{"experiment",
                                              "recording",
                                              "filter",
                                              "model",
                                              "model.bounds",
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
                                              "output"};
  return names;
}

void check_section_names(Job const& job, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < job.sections.size(); ++i) {
    Section const& section = job.sections[i];
    bool known = false;
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
