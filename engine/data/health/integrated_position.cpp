#include "engine/data/health/integrated_position.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "engine/data/unit_of_name.hpp"

namespace torquescope {
namespace {

std::optional<NamedUnit> unit_of_velocity(Examination const& exam) {
  auto const& column = exam.channels.at("velocity").column;
  auto const& names = exam.table.names;
  auto const at = static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin());
  return unit_of_name(column, at < exam.table.units.size() ? exam.table.units[at] : std::string());
}

void examine_velocity_unit(Examination& exam, std::optional<NamedUnit> const& unit) {
  if (!unit || exam.writes("velocity_per_unit") || exam.writes("position_per_unit")) return;
  bool const is_speed = unit->quantity == Quantity::angular_speed || unit->quantity == Quantity::speed;
  if (!is_speed || unit->si == 1.0) return;
  exam.add(FindingKind::unit_in_name, Grade::fault, Repair::none, "velocity", {}, unit->si, unit->word).line_to_write =
      fmt::format("velocity_per_unit = {:.10g}      (write 1 if the name is wrong)", unit->si);
}

}  // namespace

void integrate_velocity(Examination& exam) {
  auto const unit = unit_of_velocity(exam);
  examine_velocity_unit(exam, unit);
  auto const& v = exam.values("velocity");
  auto const time_of = [&](std::size_t row) {
    return exam.time_s.empty() ? static_cast<double>(row) / exam.options.rate_hz : exam.time_s[row];
  };
  double const per_unit = exam.options.velocity_factor() / exam.options.position_per_unit;
  std::vector<double> position(v.size(), missing);
  double way = 0.0;
  std::size_t before = v.size();  // the last row with a velocity; none yet
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (!std::isfinite(v[k])) continue;
    if (before < v.size()) way += (v[k] + v[before]) / 2 * (time_of(k) - time_of(before)) * per_unit;
    position[k] = way;
    before = k;
  }
  bool const slides = unit && unit->quantity == Quantity::speed;
  auto& finding = exam.add(FindingKind::position_integrated, Grade::warning, Repair::none, "velocity", {},
                           range_of(position) * std::fabs(exam.options.position_per_unit));
  finding.unit = slides ? "m" : "rad";
  exam.channels["position"] = {exam.channels.at("velocity").column, std::move(position)};
  exam.channels.erase("velocity");
}

}  // namespace torquescope
