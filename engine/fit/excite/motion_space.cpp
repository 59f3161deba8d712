#include "engine/fit/excite/motion_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"

namespace torquescope {

namespace {

using Eigen::Index;

constexpr Index samples_per_shortest_period = 64;
constexpr double smallest_size = 0.05;

std::size_t numbers_per_joint(Index harmonics) { return 2 * static_cast<std::size_t>(harmonics - 1) + 2; }

Bounds box_of(std::size_t joints, Index harmonics) {
  Bounds box;
  for (std::size_t j = 0; j < joints; ++j) {
    std::size_t const coefficients = numbers_per_joint(harmonics) - 2;
    box.lower.insert(box.lower.end(), coefficients, -1.0);
    box.lower.insert(box.lower.end(), {0.0, smallest_size});
    box.upper.insert(box.upper.end(), coefficients, 1.0);
    box.upper.insert(box.upper.end(), {1.0, 1.0});
  }
  return box;
}

// the largest factor that keeps a size below its limit
double room(double size, double limit) { return size > 0.0 ? limit / size : std::numeric_limits<double>::infinity(); }

}  // namespace

MotionSpace::MotionSpace(SerialChain const& chain, LimitShares const& shares, Index harmonics, double period_s)
    : harmonics_(harmonics),
      period_s_(period_s),
      table_(samples_per_shortest_period * harmonics, harmonics),
      hidden_(1.0 / std::cos(std::numbers::pi / static_cast<double>(samples_per_shortest_period))),
      bounds_(box_of(chain.joints.size(), harmonics)) {
  TORQUESCOPE_EXPECT(harmonics >= 2 && period_s > 0.0);
  for (std::size_t j = 0; j < chain.joints.size(); ++j) {
    auto const& joint = chain.joints[j];
    validate(std::isfinite(joint.max_speed) || (std::isfinite(joint.lower) && std::isfinite(joint.upper)), [&] {
      Problem problem;
      problem.what = fmt::format("joint {} (\"{}\") has neither a range nor a largest speed", j + 1, joint.name);
      problem.help = "write lower and upper, or max_speed, of this joint in the robot file";
      return problem;
    });
    bool const has_range = std::isfinite(joint.lower) && std::isfinite(joint.upper);
    double const centre = has_range ? 0.5 * (joint.lower + joint.upper) : 0.0;
    double const half = has_range ? 0.5 * shares.position * (joint.upper - joint.lower) : ChainJoint::no_limit;
    limits_.push_back(
        {centre - half, centre + half, shares.speed * joint.max_speed, shares.acceleration * joint.max_acceleration});
  }
}

FourierJoint MotionSpace::joint_motion(std::span<double const> point, JointLimits const& limits) const {
  // free harmonics, and the last one for rest at the beginning
  Index const free = harmonics_ - 1;
  FourierJoint joint{0.0, Eigen::VectorXd(harmonics_), Eigen::VectorXd(harmonics_)};
  joint.cosine.head(free) = Eigen::Map<Eigen::VectorXd const>(point.data(), free);
  joint.sine.head(free) = Eigen::Map<Eigen::VectorXd const>(point.data() + free, free);
  joint.cosine[free] = -joint.cosine.head(free).sum();
  Eigen::VectorXd const orders = Eigen::VectorXd::LinSpaced(free, 1.0, static_cast<double>(free));
  joint.sine[free] = -orders.dot(joint.sine.head(free)) / static_cast<double>(harmonics_);

  // as large as the limits and its size allow
  auto const shape = samples_of({period_s_, {joint}}, table_);
  double const low = shape.q.minCoeff(), high = shape.q.maxCoeff(), middle = 0.5 * (low + high);
  double const half = hidden_ * 0.5 * (high - low);
  double const largest = std::min({room(half, 0.5 * (limits.upper - limits.lower)),
                                   room(hidden_ * shape.dq.cwiseAbs().maxCoeff(), limits.speed),
                                   room(hidden_ * shape.ddq.cwiseAbs().maxCoeff(), limits.acceleration)});
  double const place = point[static_cast<std::size_t>(2 * free)], size = point[static_cast<std::size_t>(2 * free) + 1];
  double const scale = std::isfinite(largest) ? size * largest : 0.0;
  joint.cosine *= scale;
  joint.sine *= scale;

  // somewhere in the range that is left
  bool const has_range = std::isfinite(limits.lower);
  double const lowest = limits.lower + scale * half, highest = limits.upper - scale * half;
  joint.centre = (has_range ? lowest + place * (highest - lowest) : 0.0) - scale * middle;
  return joint;
}

FourierMotion MotionSpace::motion(std::span<double const> point) const {
  TORQUESCOPE_EXPECT(point.size() == bounds_.dimension());
  FourierMotion motion{period_s_, {}};
  std::size_t const each = numbers_per_joint(harmonics_);
  for (std::size_t j = 0; j < limits_.size(); ++j)
    motion.joints.push_back(joint_motion(point.subspan(j * each, each), limits_[j]));
  return motion;
}

}  // namespace torquescope
