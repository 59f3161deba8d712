#include "engine/infer/pipeline/static_torque.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/fit/statistics/held_out_gain.hpp"

namespace torquescope {

// convention: what a joint's friction and inertia make of its torque at least; a torque that position explains less
// well may have them
constexpr double least_of_a_joint = 0.05;

std::optional<Hopeless> check_static_torque(ProcessedRecord const& record, RecordPipeline const& pipeline,
                                            MotionLimits const& limits) {
  if (limits.has_one_direction || limits.has_one_speed || record.torque.size() < fewest_rows) return std::nullopt;
  auto const& owners = pipeline.model().regressor().column_owners();
  std::vector<Eigen::Index> of_position;
  bool has_position = false;
  for (std::size_t k = 0; k < owners.size(); ++k) {
    if (owners[k].needs_velocity || owners[k].needs_acceleration || owners[k].needs_time) continue;
    has_position = has_position || owners[k].needs_position;
    of_position.push_back(static_cast<Eigen::Index>(k));
  }
  if (!has_position || of_position.size() == owners.size()) return std::nullopt;
  Eigen::Index const memory = guard_rows(pipeline);
  Eigen::VectorXd const without = blocked_residuals(record.torque, record.columns(Eigen::all, of_position), memory);
  Eigen::VectorXd const with = blocked_residuals(record.torque, record.columns, memory);
  double const relerr = without.norm() / record.torque.norm();
  if (relerr > least_of_a_joint) return std::nullopt;
  if (held_out_gain(held_out_blocks(without, with, memory)).change != HeldOutChange::not_lower) return std::nullopt;
  return Hopeless{
      Verdict::data_fault,
      fmt::format("the torque is a function of the position alone (relative error {:.2g} %): inertia and friction of "
                  "a moving joint are not in it, so it is what a controller computed",
                  100.0 * relerr),
      "name the column of the measured torque or motor current in recording.columns"};
}

}  // namespace torquescope
