#include "engine/fit/excite/arm_clearance.hpp"

#include <algorithm>
#include <vector>

namespace torquescope {

namespace {

using Eigen::Vector3d;

// origins of base, links and flange, seen from the file's base frame
std::vector<Vector3d> origins(SerialChain const& chain, Eigen::Ref<Eigen::VectorXd const> const& q) {
  FramePose pose = chain.base;
  std::vector<Vector3d> points{pose.position};
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    pose = pose * joint_pose(chain.joints[i], q[static_cast<Eigen::Index>(i)]);
    points.push_back(pose.position);
  }
  points.push_back((pose * chain.flange).position);
  return points;
}

// lines of a length between one point and the next
std::vector<LineSegment> lines_between(std::vector<Vector3d> const& points) {
  constexpr double shortest_m = 1e-9;
  std::vector<LineSegment> lines;
  for (std::size_t i = 1; i < points.size(); ++i)
    if ((points[i] - points[i - 1]).norm() > shortest_m) lines.push_back({points[i - 1], points[i]});
  return lines;
}

}  // namespace

double distance(LineSegment const& a, LineSegment const& b) {
  Vector3d const along_a = a.to - a.from, along_b = b.to - b.from, between = a.from - b.from;
  double const aa = along_a.squaredNorm(), bb = along_b.squaredNorm(), ab = along_a.dot(along_b);
  double const a0 = along_a.dot(between), b0 = along_b.dot(between);
  // nearest place on line a, then on b; clamped, then once more on a
  double const cross = aa * bb - ab * ab;
  double on_a = cross > 0.0 ? std::clamp((ab * b0 - a0 * bb) / cross, 0.0, 1.0) : 0.0;
  double on_b = bb > 0.0 ? (ab * on_a + b0) / bb : 0.0;
  if (!(bb > 0.0) || on_b < 0.0 || on_b > 1.0) {
    on_b = std::clamp(on_b, 0.0, 1.0);
    on_a = aa > 0.0 ? std::clamp((ab * on_b - a0) / aa, 0.0, 1.0) : 0.0;
  }
  return (between + on_a * along_a - on_b * along_b).norm();
}

double clearance_lack(SerialChain const& chain, ClearanceLimits const& limits,
                      Eigen::Ref<Eigen::VectorXd const> const& q) {
  auto const points = origins(chain, q);
  double lack = 0.0;
  // the base and the first link stand on the table
  for (std::size_t i = 2; i < points.size(); ++i) lack = std::max(lack, limits.floor_m - points[i].z());
  if (limits.clearance_m <= 0.0) return lack;
  auto const lines = lines_between(points);
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t k = i + 2; k < lines.size(); ++k)
      lack = std::max(lack, limits.clearance_m - distance(lines[i], lines[k]));
  return lack;
}

}  // namespace torquescope
