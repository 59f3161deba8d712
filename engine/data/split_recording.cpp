#include "engine/data/split_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

Recording part_of(Recording const& whole, Eigen::Index first, Eigen::Index count) {
  Recording part = whole;
  for (auto channel :
       {&Recording::time_s, &Recording::position, &Recording::torque, &Recording::reference, &Recording::velocity,
        &Recording::acceleration, &Recording::simulated_torque, &Recording::simulated_position,
        &Recording::added_command, &Recording::external_torque, &Recording::enabled, &Recording::gear_load})
    if ((whole.*channel).size() > 0) part.*channel = (whole.*channel).segment(first, count).eval();
  if (whole.other_positions.size() > 0) part.other_positions = whole.other_positions.middleRows(first, count);
  double const from_s = static_cast<double>(first) / whole.rate_hz;
  double const length_s = static_cast<double>(count) / whole.rate_hz;
  part.name = fmt::format("{} ({:.4g} to {:.4g} s)", whole.name, from_s, from_s + length_s);
  part.left_out.clear();
  for (auto const& stretch : whole.left_out) {
    Stretch const inside{std::max(stretch.from_s - from_s, 0.0), std::min(stretch.until_s - from_s, length_s)};
    if (inside.from_s < inside.until_s) part.left_out.push_back(inside);
  }
  part.left_out_because.clear();
  for (auto one : whole.left_out_because) {
    one.where = {std::max(one.where.from_s - from_s, 0.0), std::min(one.where.until_s - from_s, length_s)};
    if (one.where.from_s < one.where.until_s) part.left_out_because.push_back(std::move(one));
  }
  return part;
}

}  // namespace

std::pair<Recording, Recording> split_recording(Recording const& whole, double share) {
  TORQUESCOPE_EXPECT(share > 0.0 && share < 1.0);
  Eigen::Index const n = whole.position.size();
  auto const head = std::clamp<Eigen::Index>(std::llround(share * static_cast<double>(n)), 1, n - 1);
  auto tail = part_of(whole, head, n - head);
  // what the examination found stands once, with the head
  tail.warnings.clear();
  tail.findings.clear();
  return {part_of(whole, 0, head), std::move(tail)};
}

}  // namespace torquescope
