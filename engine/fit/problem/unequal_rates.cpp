#include "engine/fit/problem/unequal_rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace torquescope {
namespace {

Problem different_rates(std::string const& recording, double rate_hz, std::string const& first, double first_rate_hz,
                        Section const& section) {
  Problem problem{ExitCode::bad_data,
                  fmt::format("{} keeps {:.6g} samples a second, {} keeps {:.6g} (a fit would weigh them unequally)",
                              recording, rate_hz, first, first_rate_hz)};
  problem.place = section.where("decimate_to_hz");
  problem.key = "filter.decimate_to_hz";
  problem.help = fmt::format("write filter.decimate_to_hz = {:.6g} or lower", std::min(rate_hz, first_rate_hz));
  return problem;
}

}  // namespace

void check_kept_rate(std::string const& recording, double rate_hz, std::string const& first, double first_rate_hz,
                     Section const& filter) {
  // rates are ratios of small numbers: equal ones differ by rounding at most
  validate(std::abs(rate_hz - first_rate_hz) <= 1e-9 * first_rate_hz,
           [&] { return different_rates(recording, rate_hz, first, first_rate_hz, filter); });
}

}  // namespace torquescope
