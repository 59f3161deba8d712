#pragma once
// What the last link of an arm carries, as base parameters: what is known of it, and what is to be identified.
//
// Equation   chi_base of the loaded arm = chi_base + unknown p + known; p: mass and first moments (unless known) and
//            inertia of the payload about the last link's frame
// Columns    those that are independent of the ones before, in the order of base_parameters.hpp; on a short arm one may
//            stand for a sum
// Shapes     unknown: R x P, known: R
// Units      kg, kg m, kg m^2
// Threads    plain records; free function
// Source     Gautier and Briot 2014, doi:10.1115/1.4027506

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/robot/base_parameters.hpp"

namespace torquescope {

struct Payload {
  std::optional<double> mass_kg{};                 // none: not known
  std::optional<Eigen::Vector3d> first_moments{};  // kg m, in the last link's frame; none: not known

  bool operator==(Payload const&) const = default;
};

struct PayloadColumns {
  std::vector<std::string> names, units;  // [P] "mx6", "kg m"
  Eigen::MatrixXd unknown;
  Eigen::VectorXd known;
  bool tells_scale = false;  // known is no sum of the unknown ones: torques of it have a known size
};

// m, mx, my, mz of a load, whose ten numbers are all told: its mass and its centre, with one standard error each
struct PayloadCentre {
  double mass_kg = 0.0, mass_error = 0.0;
  Eigen::Vector3d centre_m, centre_error;  // in the tip's frame
};
// numbers: in the last link's frame, with their covariance. Requires a mass that is not 0
PayloadCentre payload_centre(SerialChain const& chain, Eigen::Vector4d const& numbers,
                             Eigen::Matrix4d const& covariance);

PayloadColumns payload_columns(SerialChain const& chain, BaseParameters const& base, Payload const& payload);

}  // namespace torquescope
