#pragma once
// Recordings of one fit keep equal rates.

#include <string>

#include "engine/base/options.hpp"

namespace torquescope {

// throws Error 65: rows would weigh unequal times. `filter`: the job's [filter] section, for the place
void check_kept_rate(std::string const& recording, double rate_hz, std::string const& first, double first_rate_hz,
                     Section const& filter);

}  // namespace torquescope
