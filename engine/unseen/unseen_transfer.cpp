#include "engine/unseen/unseen_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace torquescope {

std::vector<double> transfer_errors(Eigen::MatrixXd const& columns, Eigen::VectorXd const& torque,
                                    Eigen::VectorXd const& left, Eigen::MatrixXd const& parameter_errors) {
  Eigen::MatrixXd const gram = columns.transpose() * columns;
  Eigen::VectorXd const across = columns.transpose() * left;
  double const energy = left.squaredNorm(), whole = torque.squaredNorm();
  std::vector<double> errors(static_cast<std::size_t>(parameter_errors.cols()));
  for (std::size_t k = 0; k < errors.size(); ++k) {
    auto const off = parameter_errors.col(static_cast<Eigen::Index>(k));
    double const moved = energy - 2.0 * off.dot(across) + off.dot(gram * off);
    errors[k] = std::sqrt(std::max(0.0, moved) / whole);
  }
  return errors;
}

std::optional<UnseenBeyond> beyond_twins(std::string const& recording, double relerr,
                                         std::vector<double> const& twins) {
  constexpr double surely_more = 1.25, of_torque = 0.01;
  if (twins.empty() || !std::isfinite(relerr)) return std::nullopt;
  double const usual = std::accumulate(twins.begin(), twins.end(), 0.0) / static_cast<double>(twins.size());
  double const most = *std::max_element(twins.begin(), twins.end());
  if (!(relerr > surely_more * most) || !(relerr * relerr - usual * usual > of_torque * of_torque)) return std::nullopt;
  return UnseenBeyond{recording, relerr, usual, most};
}

}  // namespace torquescope
