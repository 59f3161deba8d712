#include "engine/robot/axis_frames.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/robot/vector3.hpp"

namespace torquescope {

namespace {

using Eigen::Vector3d;

constexpr double parallel = 1e-6;  // sine of an angle
constexpr double rounding_error = 1e-12;

// origin and x axis of a frame whose z axis is known
struct Normal {
  Vector3d foot, x;
};

Vector3d foot_of(Vector3d const& point, AxisLine const& line) {
  return line.point + line.direction * line.direction.dot(point - line.point);
}

// a direction across `axis`: the root's x, y or z where one of them is
Vector3d any_across(Vector3d const& axis) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(axis[k]) < rounding_error) return Vector3d::Unit(k);
  return (Vector3d::UnitX() - axis.x() * axis).normalized();
}

// the common normal from `line` to `next`; `last` is the one before, which ends on `line`
Normal common_normal(AxisLine const& line, AxisLine const& next, Normal const& last, double length) {
  Vector3d const product = cross(line.direction, next.direction);
  double const sine = product.norm();
  if (sine <= parallel) {
    Vector3d const across = foot_of(last.foot, next) - last.foot;
    double const distance = across.norm();
    return {last.foot, distance > rounding_error * length ? Vector3d(across / distance) : last.x};
  }
  Vector3d x = product / sine;
  Vector3d const between = next.point - line.point;
  double const along = cross(between, next.direction).dot(x) / sine;
  double const towards = x.dot(between);
  // of the two directions the one that goes on from the last x, or the one that makes a positive
  double const turn = x.dot(last.x);
  if (std::abs(turn) > 1e-6 ? turn < 0.0 : towards < 0.0) x = -x;
  return {line.point + along * line.direction, x};
}

double clean(double number, double size) { return std::abs(number) <= rounding_error * size ? 0.0 : number; }

double clean_angle(double angle) {
  double const right = std::acos(0.0), nearest = right * std::round(angle / right);
  return std::abs(angle - nearest) <= rounding_error ? nearest : angle;
}

// from x_from to x_to about z
double angle_about(Vector3d const& z, Vector3d const& from, Vector3d const& to) {
  return clean_angle(std::atan2(cross(from, to).dot(z), from.dot(to)));
}

double size_of(std::vector<AxisLine> const& lines) {
  double size = 0.0;
  for (auto const& line : lines) size = std::max(size, line.point.cwiseAbs().maxCoeff());
  return size > 0.0 ? size : 1.0;
}

}  // namespace

void set_frames(std::vector<AxisLine> lines, SerialChain& chain) {
  TORQUESCOPE_EXPECT(lines.size() == chain.joints.size() && !lines.empty());
  double const length = size_of(lines);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    auto& z = lines[i].direction;
    auto const& before = lines[i - 1].direction;
    if (cross(before, z).norm() <= parallel) z = z.dot(before) < 0.0 ? Vector3d(-before) : before;
  }
  Vector3d const first = lines.front().direction;
  Normal last{foot_of(Vector3d::Zero(), lines.front()), any_across(first)};
  chain.base.rotation << last.x, cross(first, last.x), first;
  chain.base.position = last.foot;
  Vector3d z_before = first;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    auto& joint = chain.joints[i];
    auto const& line = lines[i];
    // from frame i - 1 to this axis, then along it to its own normal
    Vector3d const foot = foot_of(last.foot, line);
    joint.a = clean((foot - last.foot).dot(last.x), length);
    joint.alpha = angle_about(last.x, z_before, line.direction);
    Vector3d const landing = last.foot + joint.a * last.x;
    Normal const here =
        i + 1 < lines.size() ? common_normal(line, lines[i + 1], {landing, last.x}, length) : Normal{landing, last.x};
    joint.offset = angle_about(line.direction, last.x, here.x);
    joint.d = clean((here.foot - landing).dot(line.direction), length);
    last = here;
    z_before = line.direction;
  }
}

}  // namespace torquescope
