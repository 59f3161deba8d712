#pragma once
// A recording, a robot or another file that was given where a job is meant.
//
// Threads    function of its arguments

#include <optional>
#include <string>

#include "engine/base/error.hpp"

namespace torquescope {

// nothing: it may be a job, perhaps one with mistakes
std::optional<Problem> not_a_job(std::string const& text, std::string const& file);

}  // namespace torquescope
