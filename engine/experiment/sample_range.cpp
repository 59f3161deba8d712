#include "engine/experiment/sample_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/data/data_problem.hpp"

namespace torquescope {
namespace {

// the fourth power, of which a condition number and a standard error are made, is still a number when many are added
constexpr double most = 1e60;

}  // namespace

void refuse_huge_samples(RawTable const& table, RecordingOptions const& options) {
  auto const check = [&](std::string const& channel, std::string const& column, double unit) {
    auto const found = std::find(table.names.begin(), table.names.end(), column);
    if (found == table.names.end()) return;
    auto const& values = table.columns[static_cast<std::size_t>(found - table.names.begin())];
    auto const huge = std::find_if(values.begin(), values.end(), [&](double value) {
      return std::isfinite(value) && !(std::fabs(value * unit) <= most);
    });
    if (huge == values.end()) return;
    auto const row = static_cast<std::size_t>(huge - values.begin());
    throw Error(bad_data(
        fmt::format("\"{}\" is {:g} in {}: no {} is beyond {:g}", column, *huge, row_name(table, row), channel, most),
        table.path, line_of(table, row), "remove the row, or write the value that was meant"));
  };
  for (auto const& [channel, column] : options.columns)
    check(channel, column,
          channel == "torque" ? options.torque_factor()
          : channel == "time" ? 1.0
                              : options.position_per_unit);
  if (!options.simulated_torque.empty()) check("torque", options.simulated_torque, 1.0);
}

}  // namespace torquescope
