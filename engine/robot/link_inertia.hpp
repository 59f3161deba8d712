#pragma once
// The ten inertial parameters of a link, about the origin and along the axes of its own frame.
//
// Order      m, mx, my, mz, xx, xy, xz, yy, yz, zz: columns 10 i ... 10 i + 9 of a regressor belong to link i
// Units      kg; kg m; kg m^2
// Meaning    (mx, my, mz) is mass times centre of mass; xx ... zz are elements of the inertia tensor about the frame's
//            origin (not the centre of mass), so xy = - integral of x y dm
// Threads    values

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>

namespace torquescope {

inline constexpr Eigen::Index numbers_per_link = 10;
inline constexpr std::array<std::string_view, 10> link_number_names{"m",  "mx", "my", "mz", "xx",
                                                                    "xy", "xz", "yy", "yz", "zz"};
enum class LinkNumber : int { m, mx, my, mz, xx, xy, xz, yy, yz, zz };

using LinkVector = Eigen::Matrix<double, numbers_per_link, 1>;

// a frame seen from another: point in the other frame = rotation * point + position
struct FramePose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();

  FramePose operator*(FramePose const& inner) const;  // of `inner`'s frame, seen from where this pose is seen
  FramePose inverse() const;
};

struct LinkInertia {
  double mass = 0.0;                                       // kg
  Eigen::Vector3d first_moment = Eigen::Vector3d::Zero();  // kg m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();       // kg m^2, about the frame's origin, symmetric

  static LinkInertia from_vector(LinkVector const& numbers);
  // about_centre: along the link frame's axes
  static LinkInertia from_centre(double mass, Eigen::Vector3d const& centre, Eigen::Matrix3d const& about_centre);
  LinkVector vector() const;
  // the same body described in the frame that `pose` is seen from
  LinkInertia seen_from(FramePose const& pose) const;
  LinkInertia operator+(LinkInertia const& other) const;  // both in the same frame: rigidly joined
  Eigen::Matrix3d about_centre() const;                   // Requires mass > 0
};

// why no body has this inertia ("breaks the triangle inequality"), or "". A rod or a plate is a body
// Source     Traversaro et al. 2016, doi:10.1109/IROS.2016.7759801
std::string body_fault(LinkInertia const& link);

}  // namespace torquescope
