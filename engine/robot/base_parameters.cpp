#include "engine/robot/base_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/ordered_basis.hpp"

namespace torquescope {

namespace {

using Eigen::Index;

// dependent columns leave 1e-13 of their length, independent ones of arms at least 1e-6
constexpr double independence = 1e-9;

// the longest of a and d: in its unit an arm of millimetres is like one of metres
double unit_length(SerialChain const& chain) {
  double length = 0.0;
  for (auto const& joint : chain.joints) length = std::max({length, std::abs(joint.a), std::abs(joint.d)});
  return length > 0.0 ? length : 1.0;
}

// lengths in units of `length`; gravity is 1, which only sets the unit of time
SerialChain scaled(SerialChain chain, double length) {
  for (auto& joint : chain.joints) {
    joint.a /= length;
    joint.d /= length;
  }
  if (double const g = chain.gravity.norm(); g > 0.0) chain.gravity /= g;
  if (chain.has_coupled_drives()) {
    Eigen::VectorXd units = Eigen::VectorXd::Ones(chain.size());  // of a joint's position, in the new one
    for (Index j = 0; j < chain.size(); ++j)
      if (chain.joints[static_cast<std::size_t>(j)].kind == JointKind::prismatic) units[j] = length;
    chain.transmission = (units.cwiseInverse().asDiagonal() * chain.transmission * units.asDiagonal()).eval();
  }
  return chain;
}

// times length to this power makes a standard parameter a mass times length^2
int missing_lengths(SerialChain const& chain, Index column) {
  using enum LinkNumber;
  Index const n_links = numbers_per_link * chain.size();
  if (column >= n_links)
    return chain.joints[static_cast<std::size_t>(column - n_links)].kind == JointKind::revolute ? 0 : 2;
  auto const number = static_cast<LinkNumber>(column % numbers_per_link);
  if (number == m) return 2;
  return number == mx || number == my || number == mz ? 1 : 0;
}

// joints that feel a drive: first and last
std::pair<Index, Index> rows_of_drive(SerialChain const& chain, Index motor) {
  Index first = motor, last = motor;
  for (Index j = 0; chain.has_coupled_drives() && j < chain.size(); ++j) {
    if (chain.transmission(motor, j) == 0.0) continue;
    first = std::min(first, j);
    last = std::max(last, j);
  }
  return {first, last};
}

// rows of random motions, three times as many as there are columns
Eigen::MatrixXd sampled_regressor(SerialChain const& chain, DriveInertias drives) {
  Index const n = chain.size(), n_columns = (drives == DriveInertias::included ? 11 : 10) * n, n_samples = 33;
  Eigen::MatrixXd rows(n * n_samples, n_columns);
  RandomStream random({42, 0, RandomDomain::resampling}, 0, 0);
  Eigen::VectorXd q(n), dq(n), ddq(n);
  for (Index sample = 0; sample < n_samples; ++sample) {
    for (Index i = 0; i < n; ++i) {
      q[i] = random.uniform(-3.2, 3.2);
      dq[i] = random.uniform(-1.0, 1.0);
      ddq[i] = random.uniform(-1.0, 1.0);
    }
    rows.middleRows(n * sample, n) = arm_regressor(chain, q, dq, ddq, drives);
  }
  return rows;
}

std::vector<Index> order_of_choice(Index n, DriveInertias drives) {
  using enum LinkNumber;
  std::vector<Index> order;
  auto const append = [&](Index link, LinkNumber number) {
    order.push_back(numbers_per_link * link + static_cast<Index>(number));
  };
  for (Index link = n - 1; link >= 0; --link)
    for (auto const number : {zz, xy, xz, yz, mx, my, xx}) append(link, number);
  if (drives == DriveInertias::included)
    for (Index joint = n - 1; joint >= 0; --joint) order.push_back(numbers_per_link * n + joint);
  for (Index link = n - 1; link >= 0; --link)
    for (auto const number : {mz, yy, m}) append(link, number);
  return order;
}

char const* unit_of(SerialChain const& chain, Index column) {
  constexpr char const* units[] = {"kg m^2", "kg m", "kg"};
  return units[missing_lengths(chain, column)];
}

// "xx2" becomes "xxr2"; drives keep their names
std::string gathered_name(std::string name, bool gathers) {
  if (gathers && !name.starts_with("drive_")) name.insert(name.find_first_of("0123456789"), "r");
  return name;
}

}  // namespace

BaseParameters::BaseParameters(SerialChain const& chain, DriveInertias drives)
    : standard_names_(torquescope::standard_names(chain, drives)) {
  Index const n = chain.size(), n_links = numbers_per_link * n;
  double const length = unit_length(chain);
  auto const basis =
      ordered_basis(sampled_regressor(scaled(chain, length), drives), order_of_choice(n, drives), independence);
  standard_size_ = basis.sums.cols();
  columns_ = basis.kept;
  for (Index const column : basis.zero) without_effect_.push_back(standard_names_[static_cast<std::size_t>(column)]);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    Index const stands = columns_[k];
    bool const is_drive = stands >= n_links;
    auto const [first, last] =
        is_drive ? rows_of_drive(chain, stands - n_links) : std::pair(Index{0}, stands / numbers_per_link);
    BaseParameter parameter{"", unit_of(chain, stands), stands, first, last, {}};
    for (Index column = 0; column < standard_size_; ++column) {
      double const factor = basis.sums(static_cast<Index>(k), column);
      int const lengths = missing_lengths(chain, column) - missing_lengths(chain, stands);
      if (column != stands && factor != 0.0) parameter.gathers.push_back({column, factor * std::pow(length, lengths)});
    }
    parameter.name = gathered_name(standard_names_[static_cast<std::size_t>(stands)], !parameter.gathers.empty());
    parameters_.push_back(std::move(parameter));
  }
}

Eigen::MatrixXd BaseParameters::pick(Eigen::Ref<Eigen::MatrixXd const> const& regressor) const {
  TORQUESCOPE_EXPECT(regressor.cols() == standard_size_);
  Eigen::MatrixXd picked(regressor.rows(), size());
  for (Index k = 0; k < size(); ++k) picked.col(k) = regressor.col(columns_[static_cast<std::size_t>(k)]);
  return picked;
}

Eigen::VectorXd BaseParameters::from_standard(Eigen::Ref<Eigen::VectorXd const> const& standard) const {
  TORQUESCOPE_EXPECT(standard.size() == standard_size_);
  Eigen::VectorXd values(size());
  for (Index k = 0; k < size(); ++k) {
    auto const& parameter = parameters_[static_cast<std::size_t>(k)];
    values[k] = standard[parameter.column];
    for (auto const& term : parameter.gathers) values[k] += term.factor * standard[term.column];
  }
  return values;
}

Eigen::VectorXd BaseParameters::to_standard(Eigen::Ref<Eigen::VectorXd const> const& values) const {
  TORQUESCOPE_EXPECT(values.size() == size());
  Eigen::VectorXd standard = Eigen::VectorXd::Zero(standard_size_);
  for (Index k = 0; k < size(); ++k) standard[columns_[static_cast<std::size_t>(k)]] = values[k];
  return standard;
}

}  // namespace torquescope
