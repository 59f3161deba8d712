#include "engine/app/result/map_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"
#include "engine/base/quantity_text.hpp"

namespace torquescope {

namespace {

constexpr std::size_t spark_places = 16;
constexpr double quiet_z = 4.0;  // a row without a stronger cell stays low

// z before or after
using CellZ = double MapCell::*;

// an axis and the share of the residual's energy that is told of it
struct AxisLine {
  MapAxis const* axis;
  double share;
};

// the strongest z of each place; NaN where no cell holds a sample
std::array<double, spark_places> strengths(MapAxis const& axis, CellZ z) {
  std::array<double, spark_places> strongest;
  strongest.fill(std::nan(""));
  for (std::size_t i = 0; i < axis.cells.size(); ++i) {
    double const value = axis.cells[i].*z;
    if (axis.cells[i].samples == 0 || !std::isfinite(value)) continue;
    double const size = axis.is_spectrum ? std::max(0.0, value) : std::abs(value);
    double& place = strongest[i * spark_places / axis.cells.size()];
    place = std::isnan(place) ? size : std::max(place, size);
  }
  return strongest;
}

std::string sparkline(MapAxis const& axis, CellZ z, bool utf8) {
  constexpr std::array<char const*, 8> blocks{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  constexpr std::array<char const*, 8> letters{"_", ".", "-", "=", "+", "*", "%", "#"};
  auto const places = strengths(axis, z);
  double highest = quiet_z;
  for (double place : places)
    if (place > highest) highest = place;
  std::string text;
  for (double place : places) {
    if (std::isnan(place)) {
      text += " ";
      continue;
    }
    auto const level = std::min<std::size_t>(7, static_cast<std::size_t>(8.0 * place / highest));
    text += utf8 ? blocks[level] : letters[level];
  }
  return text;
}

std::string axis_title(std::string const& axis) {
  std::string title = printable(axis);
  std::replace(title.begin(), title.end(), '_', ' ');
  // which reversal is the short form's only question
  return title == "since velocity reversal" ? "since reversal" : title;
}

// the shares are said to be of the residual where the first line has room for it
std::string axis_lines(std::vector<AxisLine> const& lines, CellZ z, bool utf8) {
  using Align = TextTable::Align;
  TextTable table({Align::left, Align::right, Align::left, Align::left, Align::right}, std::string(lead_columns, ' '));
  for (auto const& [axis, share] : lines)
    table.row({axis_title(axis->axis), two_digits(axis->cells.front().from), sparkline(*axis, z, utf8),
               two_digits(axis->cells.back().to) + " " + printable(axis->unit),
               std::isfinite(share) ? fmt::format("{:.0f} %", 100.0 * share) : ""});
  std::string text = table.text(page_width());
  std::string const of = " of the residual";
  std::size_t const end = std::min(text.find('\n'), text.size());
  if (!lines.empty() && columns_of(text.substr(0, end)) + columns_of(of) <= page_width()) text.insert(end, of);
  return text;
}

MapAxis const* find_axis(JointDiagnosis const& joint, std::string const& name) {
  auto const found =
      std::find_if(joint.map.begin(), joint.map.end(), [&](MapAxis const& one) { return one.axis == name; });
  return found == joint.map.end() || found->cells.empty() ? nullptr : &*found;
}

}  // namespace

std::string where_text(JointDiagnosis const& joint, bool utf8) {
  if (joint.map.empty()) return "";
  std::vector<AxisLine> found;
  for (auto const& axis : joint.map)
    if (!axis.regions.empty() && !axis.cells.empty()) found.push_back({&axis, axis.energy_share});
  std::stable_sort(found.begin(), found.end(), [](AxisLine const& a, AxisLine const& b) { return a.share > b.share; });
  std::string text = axis_lines(found, &MapCell::z, utf8);
  if (!found.empty())
    text += hanging(
        std::string(lead_columns, ' '),
        "%: energy that goes with this axis, beyond the replicates; axes overlap, so the shares need not add up");
  std::size_t const quiet = joint.map.size() - found.size();
  if (quiet > 0)
    text += fmt::format("{}{}{} {}: nothing beyond the replicates\n", std::string(lead_columns, ' '), quiet,
                        found.empty() ? "" : " more", quiet == 1 ? "axis" : "axes");
  return lead("where") + text.substr(lead_columns);
}

std::string what_is_left_text(JointDiagnosis const& joint, bool utf8) {
  std::vector<AxisLine> left;
  for (auto const& part : joint.unexplained) {
    MapAxis const* axis = find_axis(joint, part.where.axis);
    // of several parts on one axis the first is the largest
    bool const is_new = std::none_of(left.begin(), left.end(), [&](AxisLine const& one) { return one.axis == axis; });
    if (axis && is_new) left.push_back({axis, part.energy_share});
  }
  return left.empty() ? "" : lead("left") + axis_lines(left, &MapCell::after_z, utf8).substr(lead_columns);
}

}  // namespace torquescope
