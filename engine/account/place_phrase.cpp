// Where on an axis something is, in words.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/account/sentences.hpp"
#include "engine/base/contract.hpp"
#include "engine/base/quantity_text.hpp"

namespace torquescope {

namespace {

constexpr double pi = 3.14159265358979323846;

// of the axis as the map shows it; without a map nothing is at its end
struct Extent {
  double from = -HUGE_VAL, to = HUGE_VAL;
  double length() const { return to - from; }
};

Extent extent_of(JointDiagnosis const& joint, std::string const& axis) {
  for (auto const& row : joint.map)
    if (row.axis == axis && !row.cells.empty()) return {row.cells.front().from, row.cells.back().to};
  return {};
}

// an interval with what it touches: one cell and a bit is the end
struct Place {
  AxisInterval const& interval;
  bool at_start = false, at_end = false;

  Place(AxisInterval const& given, Extent const& extent) : interval(given) {
    double const slack = std::isfinite(extent.length()) ? 0.03 * extent.length() : 0.0;
    at_start = given.from <= extent.from + slack;
    at_end = given.to >= extent.to - slack;
  }
  std::string from() const { return quantity_text(interval.from, interval.unit); }
  std::string to() const { return quantity_text(interval.to, interval.unit); }
  std::string between() const { return between_text(interval.from, interval.to, interval.unit); }
};

std::string velocity_phrase(Place const& place) {
  double const from = place.interval.from, to = place.interval.to;
  std::string const& unit = place.interval.unit;
  if (place.at_start && place.at_end) return "at all speeds";
  if (from < 0.0 && to > 0.0 && std::abs(from + to) <= 0.3 * std::max(-from, to))
    return fmt::format("below {} in both directions", quantity_text(std::max(-from, to), unit));
  if (from >= 0.0 && place.at_end) return fmt::format("above {} in the positive direction", place.from());
  if (to <= 0.0 && place.at_start) return fmt::format("above {} in the negative direction", quantity_text(-to, unit));
  return "at speeds " + place.between();
}

// one of two intervals
std::string side_phrase(Place const& place) {
  if (place.at_start) return "below " + place.to();
  if (place.at_end) return "above " + place.from();
  return place.between();
}

// two intervals of which one mirrors the other, in one phrase; "" when they do not
std::string both_directions(Place const& negative, Place const& positive) {
  double const outer = std::max(-negative.interval.from, positive.interval.to);
  double const slowest = std::min(-negative.interval.to, positive.interval.from);
  constexpr double alike = 0.1;
  if (!(slowest > 0.0) || std::abs(negative.interval.to + positive.interval.from) > alike * outer) return "";
  std::string const& unit = positive.interval.unit;
  if (negative.at_start && positive.at_end)
    return fmt::format("above {} in both directions", quantity_text(slowest, unit));
  if (std::abs(negative.interval.from + positive.interval.to) > alike * outer) return "";
  AxisInterval const both{positive.interval.axis, slowest, outer, unit};
  return fmt::format("at speeds {} in both directions", Place(both, {}).between());
}

std::string distance_phrase(Place const& place, std::string const& event) {
  if (place.at_start && place.at_end) return "at all distances after " + event;
  if (place.at_start || place.interval.from <= 0.0) return fmt::format("within {} after {}", place.to(), event);
  return fmt::format("{} after {}", place.between(), event);
}

std::string time_phrase(Place const& place) {
  if (place.at_start && place.at_end) return "all the time";
  if (place.at_end) return "after " + place.from();
  if (place.at_start) return "before " + place.to();
  return place.between();
}

std::string spectrum_phrase(Place const& place) {
  double const from = place.interval.from, to = place.interval.to;
  double const middle = 0.5 * (from + to);
  bool const narrow = to - from <= 0.3 * middle;
  std::string const& unit = place.interval.unit;
  if (place.at_start && place.at_end)
    return unit == "1/m" ? "at all wavelengths" : unit == "1/rad" ? "at all orders of the angle" : "at all frequencies";
  if (unit == "1/m") {
    // k waves per 2 pi metres mean nothing to anybody: a wavelength does
    if (narrow) return fmt::format("with a wavelength around {}", quantity_text(2.0 * pi / middle, "m"));
    return "with wavelengths " + between_text(2.0 * pi / to, 2.0 * pi / std::max(from, 1e-9), "m");
  }
  std::string const words = unit == "1/rad" ? "waves per turn" : unit;
  if (narrow) return fmt::format("around {} {}", two_digits(middle), words);
  return between_text(from, to, words);
}

}  // namespace

std::string place_phrase(JointDiagnosis const& joint, AxisInterval const& interval) {
  if (!std::isfinite(interval.from) || !std::isfinite(interval.to)) return "";
  Place const place(interval, extent_of(joint, interval.axis));
  bool const everywhere = place.at_start && place.at_end;
  if (interval.axis == "velocity") return velocity_phrase(place);
  if (interval.axis == "since_velocity_reversal") return distance_phrase(place, "a reversal");
  if (interval.axis == "since_torque_reversal") return distance_phrase(place, "the torque changes its sign");
  if (interval.axis == "time") return time_phrase(place);
  if (interval.axis == "frequency" || interval.axis == "order") return spectrum_phrase(place);
  if (interval.axis == "position") return everywhere ? "all along the travel" : place.between();
  if (interval.axis == "load") return everywhere ? "at all loads" : "at loads " + place.between();
  if (interval.axis == "acceleration")
    return everywhere ? "at all accelerations" : "at accelerations " + place.between();
  return "";
}

std::string place_phrase(JointDiagnosis const& joint, std::vector<AxisInterval> const& intervals) {
  if (intervals.empty()) return "";
  if (intervals.size() == 1) return place_phrase(joint, intervals.front());
  TORQUESCOPE_EXPECT(intervals.size() == 2);
  auto const& [axis, from, to, unit] = intervals.front();
  Extent const extent = extent_of(joint, axis);
  Place const low(intervals.front(), extent), high(intervals.back(), extent);
  // both reach the same end, or one another: as good as one
  if ((low.at_start && high.at_start) || (low.at_end && high.at_end) || intervals.back().from <= to)
    return place_phrase(
        joint, AxisInterval{axis, std::min(from, intervals.back().from), std::max(to, intervals.back().to), unit});
  if (axis == "velocity") {
    if (std::string mirrored = both_directions(low, high); !mirrored.empty()) return mirrored;
    return fmt::format("at velocities {} and {}", side_phrase(low), side_phrase(high));
  }
  if (axis == "load") return fmt::format("at loads {} and {}", side_phrase(low), side_phrase(high));
  if (axis == "acceleration") return fmt::format("at accelerations {} and {}", side_phrase(low), side_phrase(high));
  if (axis == "position") return fmt::format("at positions {} and {}", side_phrase(low), side_phrase(high));
  return fmt::format("{} and {}", place_phrase(joint, intervals.front()), place_phrase(joint, intervals.back()));
}

}  // namespace torquescope
