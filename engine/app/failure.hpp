#pragma once
// Whatever was thrown, as problems a person can act on.

#include <exception>
#include <vector>

#include "engine/base/error.hpp"

namespace torquescope {

// Error keeps its problems; a broken promise and anything unknown become exit code 70
std::vector<Problem> problems_of(std::exception_ptr failure);

}  // namespace torquescope
