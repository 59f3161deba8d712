#pragma once
// A Problem at a key of a job section: where the key was written, or where the section begins.

#include <string>
#include <utility>

#include "engine/base/options.hpp"

namespace torquescope {

inline Problem problem_at(Section const& section, std::string const& key, std::string what, std::string help) {
  Problem problem;
  problem.what = std::move(what);
  problem.place = section.where(key);
  problem.key = section.name + "." + key;
  problem.help = std::move(help);
  return problem;
}

}  // namespace torquescope
