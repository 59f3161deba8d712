#include "engine/robot/payload.hpp"

#include <algorithm>
#include <cmath>

#include "engine/robot/ordered_basis.hpp"

namespace torquescope {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// places among the numbers of a link
struct At {
  static constexpr Index m = 0, mx = 1, my = 2, mz = 3, xx = 4, xy = 5, xz = 6, yy = 7, yz = 8, zz = 9;
};

// as base parameters stand
std::vector<Index> unknown_numbers(Payload const& payload) {
  // where it is no sum of the others
  if (!payload.mass_kg) return {At::zz, At::xy, At::xz, At::yz, At::mx, At::my, At::xx, At::mz, At::yy, At::m};
  if (payload.first_moments) return {At::zz, At::xy, At::xz, At::yz, At::xx, At::yy};
  return {At::zz, At::xy, At::xz, At::yz, At::mx, At::my, At::xx, At::mz, At::yy};
}

}  // namespace

PayloadCentre payload_centre(SerialChain const& chain, Eigen::Vector4d const& numbers,
                             Eigen::Matrix4d const& covariance) {
  double const mass = numbers[0];
  Eigen::Vector3d const centre = numbers.tail<3>() / mass;
  Eigen::Matrix3d const into = chain.flange.rotation.transpose();
  Eigen::Matrix<double, 3, 4> slope;
  slope << -centre / mass, Eigen::Matrix3d::Identity() / mass;
  slope = (into * slope).eval();
  PayloadCentre found;
  found.mass_kg = mass;
  found.mass_error = std::sqrt(covariance(0, 0));
  found.centre_m = into * (centre - chain.flange.position);
  found.centre_error = (slope * covariance * slope.transpose()).diagonal().cwiseSqrt();
  return found;
}

PayloadColumns payload_columns(SerialChain const& chain, BaseParameters const& base, Payload const& payload) {
  constexpr double independent = 1e-9;
  Index const first = numbers_per_link * (chain.size() - 1);
  auto const moved = [&](Index number, double value) -> VectorXd {
    return base.from_standard(value * VectorXd::Unit(base.standard_size(), first + number));
  };
  PayloadColumns columns;
  columns.known = moved(At::m, payload.mass_kg.value_or(0.0));
  if (payload.first_moments)
    for (Index axis = 0; axis < 3; ++axis) columns.known += moved(At::mx + axis, (*payload.first_moments)[axis]);

  // unknown numbers, then what is known; more rows than columns
  auto const numbers = unknown_numbers(payload);
  auto const count = static_cast<Index>(numbers.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(std::max(base.size(), count + 2), count + 1);
  std::vector<Index> order;
  for (Index k = 0; k <= count; ++k) {
    all.col(k).head(base.size()) = k < count ? moved(numbers[static_cast<std::size_t>(k)], 1.0) : columns.known;
    order.push_back(k);
  }
  auto kept = ordered_basis(all, order, independent).kept;
  columns.tells_scale = !kept.empty() && kept.back() == count;
  if (columns.tells_scale) kept.pop_back();
  // listed as a link's numbers are
  std::sort(kept.begin(), kept.end(), [&](Index a, Index b) {
    return numbers[static_cast<std::size_t>(a)] < numbers[static_cast<std::size_t>(b)];
  });
  columns.unknown = all.topRows(base.size())(Eigen::all, kept);
  for (Index const k : kept) {
    Index const number = numbers[static_cast<std::size_t>(k)];
    columns.names.push_back(base.standard_names()[static_cast<std::size_t>(first + number)]);
    columns.units.emplace_back(number == At::m ? "kg" : number < At::xx ? "kg m" : "kg m^2");
  }
  return columns;
}

}  // namespace torquescope
