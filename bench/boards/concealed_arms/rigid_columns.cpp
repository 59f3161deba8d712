#include "concealed_arms/rigid_columns.hpp"

#include <Eigen/Geometry>
#include <vector>

namespace concealed_arms {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Axis {
  Vector3d along, at;
};

struct Frame {
  Matrix3d turned = Matrix3d::Identity();
  Vector3d at = Vector3d::Zero(), speed = Vector3d::Zero(), turning = Vector3d::Zero();  // w and dw
  Vector3d acceleration = Vector3d::Zero();  // of the origin, weight included
};

Matrix3d cross(Vector3d const& w) {
  Matrix3d m;
  m << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  return m;
}

// a point that moves with the frame
void move(Frame& frame, Vector3d const& step) {
  Vector3d const arm = frame.turned * step;
  frame.at += arm;
  frame.acceleration += frame.turning.cross(arm) + frame.speed.cross(frame.speed.cross(arm));
}

void turn_x(Frame& frame, double angle) {
  frame.turned *= Eigen::AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix();
}

Axis turn_joint(Frame& frame, double theta, double v, double a) {
  Axis const axis{frame.turned.col(2), frame.at};
  frame.turned *= Eigen::AngleAxisd(theta, Vector3d::UnitZ()).toRotationMatrix();
  frame.turning += a * axis.along + v * frame.speed.cross(axis.along);
  frame.speed += v * axis.along;
  return axis;
}

// force and moment about the frame's origin for each of the link's ten numbers
Eigen::Matrix<double, 6, 10> wrenches(Frame const& frame) {
  Eigen::Matrix<double, 6, 10> columns = Eigen::Matrix<double, 6, 10>::Zero();
  Matrix3d const spin = cross(frame.turning) + cross(frame.speed) * cross(frame.speed);
  columns.col(0).head<3>() = frame.acceleration;
  for (int i = 0; i < 3; ++i) {
    Vector3d const direction = frame.turned.col(i);
    columns.col(1 + i).head<3>() = spin * direction;
    columns.col(1 + i).tail<3>() = direction.cross(frame.acceleration);
  }
  int column = 4;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      Matrix3d unit = Matrix3d::Zero();
      unit(i, j) = unit(j, i) = 1.0;
      Matrix3d const inertia = frame.turned * unit * frame.turned.transpose();
      columns.col(column++).tail<3>() = inertia * frame.turning + frame.speed.cross(Vector3d(inertia * frame.speed));
    }
  }
  return columns;
}

}  // namespace

Eigen::MatrixXd torque_columns(Arm const& arm, Gravity const& gravity, Eigen::VectorXd const& q,
                               Eigen::VectorXd const& v, Eigen::VectorXd const& a) {
  int const n = arm.joints();
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n, 14 * n);
  std::vector<Axis> axes;
  Frame frame;
  frame.acceleration = -Vector3d(gravity[0], gravity[1], gravity[2]);
  for (int i = 0; i < n; ++i) {
    Link const& link = arm.links[static_cast<std::size_t>(i)];
    if (!arm.standard_dh) {
      move(frame, {link.a, 0.0, 0.0});
      turn_x(frame, link.alpha);
      move(frame, {0.0, 0.0, link.d});
    }
    axes.push_back(turn_joint(frame, q[i] + link.offset, v[i], a[i]));
    if (arm.standard_dh) {
      move(frame, {link.a, 0.0, link.d});
      turn_x(frame, link.alpha);
    }
    auto const wrench = wrenches(frame);
    for (int k = 0; k <= i; ++k) {
      auto const& axis = axes[static_cast<std::size_t>(k)];
      Vector3d const lever = frame.at - axis.at;
      columns.block(k, 10 * i, 1, 10) =
          axis.along.transpose() * wrench.bottomRows<3>() + axis.along.transpose() * cross(lever) * wrench.topRows<3>();
    }
    double const sign = v[i] > 0.0 ? 1.0 : v[i] < 0.0 ? -1.0 : 0.0;
    columns.block(i, 10 * n + 4 * i, 1, 4) << a[i], v[i], sign, 1.0;
  }
  return columns;
}

Eigen::VectorXd parameters(Arm const& arm) {
  int const n = arm.joints();
  Eigen::VectorXd values(14 * n);
  for (int i = 0; i < n; ++i) {
    Link const& link = arm.links[static_cast<std::size_t>(i)];
    double const m = link.mass, x = link.centre[0], y = link.centre[1], z = link.centre[2];
    auto const& own = link.inertia;
    values.segment(10 * i, 10) << m, m * x, m * y, m * z, own[0] + m * (y * y + z * z), own[1] - m * x * y,
        own[2] - m * x * z, own[3] + m * (x * x + z * z), own[4] - m * y * z, own[5] + m * (x * x + y * y);
    values.segment(10 * n + 4 * i, 4) << link.drive_inertia, link.viscous, link.coulomb, link.offset_torque;
  }
  return values;
}

}  // namespace concealed_arms
