#pragma once
// Which sections a job may have, and reading one by its option table.
//
// Errors     problems are appended (78)

#include <optional>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/experiment/job/job.hpp"

namespace torquescope {

std::vector<std::string> const& known_sections();
// J of "model.joint_J"; nothing of any other section
std::optional<std::size_t> joint_of_section(std::string const& name);
void check_section_names(Job const& job, std::vector<Problem>& problems);

// an absent section is an empty one: all defaults
Section section_or_empty(Job const& job, std::string const& name);

template <class Options>
Options read_options(Job const& job, std::vector<Problem>& problems) {
  Options options;
  Options::table().apply(section_or_empty(job, Options::table().section()), options, problems);
  return options;
}

// what becomes the name of a file, a line of a batch script and words on a page is never a path, and never two lines
bool is_a_name(std::string const& text);

}  // namespace torquescope
