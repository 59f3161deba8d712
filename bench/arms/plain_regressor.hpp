#pragma once
// What Pinocchio's computeJointTorqueRegressor does, in plain Eigen: where that library is absent, and beside it.
//
// Method     outwards velocities and accelerations; from the tip inwards a body's 6 x 10 columns, carried to each joint
//            before it. Columns of a link: m, first moments, xx xy xz yy yz zz about its own frame
// Source     Khalil and Dombre 2002, Modeling, Identification and Control of Robots, sections 9.5 and 12.3

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace peers {

struct Joint {
  int slides = 0;
  double a = 0.0, alpha = 0.0, d = 0.0, offset = 0.0;  // modified Denavit-Hartenberg
};

struct Arm {
  std::vector<Joint> joints{};
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::vector<std::vector<Eigen::Index>> standing{};  // standard columns in the row of each joint
};

class PlainRegressor {
 public:
  explicit PlainRegressor(Arm const& arm) : arm_(arm), links_(arm.joints.size()) {
    auto const n = static_cast<Eigen::Index>(arm.joints.size());
    phi_ = Eigen::MatrixXd::Zero(n, 10 * n);
  }

  // where a standard column stands in what the call returns
  static Eigen::Index place(Eigen::Index column) { return column; }

  template <class Vector>
  Eigen::MatrixXd const& operator()(Vector const& q, Vector const& dq, Vector const& ddq) {
    outward(q, dq, ddq);
    for (Eigen::Index link = phi_.rows() - 1; link >= 0; --link) {
      Columns columns = columns_of(links_[static_cast<std::size_t>(link)]);
      for (Eigen::Index row = link; row >= 0; --row) {
        auto const at = static_cast<std::size_t>(row);
        phi_.block<1, 10>(row, 10 * link) = columns.row(arm_.joints[at].slides != 0 ? 2 : 5);
        if (row == 0) break;
        Columns inward;
        inward.topRows<3>().noalias() = links_[at].rotation * columns.topRows<3>();
        inward.bottomRows<3>().noalias() = links_[at].rotation * columns.bottomRows<3>();
        inward.bottomRows<3>().noalias() += skew(links_[at].position) * inward.topRows<3>();
        columns = inward;
      }
    }
    return phi_;
  }

 private:
  using Vector3 = Eigen::Vector3d;
  using Matrix3 = Eigen::Matrix3d;
  using Columns = Eigen::Matrix<double, 6, 10>;
  struct Link {
    Matrix3 rotation;
    Vector3 position, omega, alpha, acceleration;
  };

  static Matrix3 skew(Vector3 const& v) {
    Matrix3 matrix;
    matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
    return matrix;
  }
  static Vector3 cross(Vector3 const& a, Vector3 const& b) {
    return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
  }
  static Eigen::Matrix<double, 3, 6> inertia_columns(Vector3 const& w) {
    Eigen::Matrix<double, 3, 6> columns;
    columns << w.x(), w.y(), w.z(), 0.0, 0.0, 0.0,  //
        0.0, w.x(), 0.0, w.y(), w.z(), 0.0,         //
        0.0, 0.0, w.x(), 0.0, w.y(), w.z();
    return columns;
  }
  static Columns columns_of(Link const& link) {
    Matrix3 const turning = skew(link.omega);
    Columns columns = Columns::Zero();
    columns.block<3, 1>(0, 0) = link.acceleration;
    columns.block<3, 3>(0, 1).noalias() = turning * turning;
    columns.block<3, 3>(0, 1) += skew(link.alpha);
    columns.block<3, 3>(3, 1) = -skew(link.acceleration);
    columns.block<3, 6>(3, 4).noalias() = turning * inertia_columns(link.omega);
    columns.block<3, 6>(3, 4) += inertia_columns(link.alpha);
    return columns;
  }

  template <class Vector>
  void outward(Vector const& q, Vector const& dq, Vector const& ddq) {
    Link before{Matrix3::Identity(), Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), -arm_.gravity};
    for (std::size_t i = 0; i < links_.size(); ++i) {
      Joint const& joint = arm_.joints[i];
      Link& link = links_[i];
      auto const k = static_cast<Eigen::Index>(i);
      bool const slides = joint.slides != 0;
      double const theta = joint.offset + (slides ? 0.0 : q[k]), d = joint.d + (slides ? q[k] : 0.0);
      double const ct = std::cos(theta), st = std::sin(theta), ca = std::cos(joint.alpha), sa = std::sin(joint.alpha);
      link.rotation << ct, -st, 0.0, ca * st, ca * ct, -sa, sa * st, sa * ct, ca;
      link.position << joint.a, -sa * d, ca * d;
      Vector3 const carried = before.acceleration + cross(before.alpha, link.position) +
                              cross(before.omega, cross(before.omega, link.position));
      link.omega.noalias() = link.rotation.transpose() * before.omega;
      link.alpha.noalias() = link.rotation.transpose() * before.alpha;
      link.acceleration.noalias() = link.rotation.transpose() * carried;
      Vector3 const axis(0.0, 0.0, 1.0);
      if (slides) {
        link.acceleration += 2.0 * dq[k] * cross(link.omega, axis) + ddq[k] * axis;
      } else {
        link.alpha += dq[k] * cross(link.omega, axis) + ddq[k] * axis;
        link.omega.z() += dq[k];
      }
      before = link;
    }
  }

  Arm arm_;
  std::vector<Link> links_;
  Eigen::MatrixXd phi_;
};

}  // namespace peers
