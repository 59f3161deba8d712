#include "engine/infer/pipeline/left_out_rows.hpp"

#include "engine/base/contract.hpp"

namespace torquescope {

LeftOutRows& LeftOutRows::operator+=(LeftOutRows const& other) {
  for (double LeftOutRows::*part : {&LeftOutRows::rows, &LeftOutRows::rows_left_out, &LeftOutRows::energy,
                                    &LeftOutRows::energy_left_out, &LeftOutRows::torque, &LeftOutRows::after})
    this->*part += other.*part;
  return *this;
}

LeftOutRows left_out_rows(Eigen::VectorXd const& torque, Eigen::VectorXd const& left_before,
                          Eigen::VectorXd const& left_after, std::vector<Eigen::Index> const& kept_rows) {
  TORQUESCOPE_EXPECT(torque.size() == left_before.size() && torque.size() == left_after.size());
  LeftOutRows result;
  result.rows = static_cast<double>(torque.size());
  result.rows_left_out = result.rows - static_cast<double>(kept_rows.size());
  result.energy = left_before.squaredNorm();
  result.energy_left_out = result.energy - left_before(kept_rows).squaredNorm();
  result.torque = torque.squaredNorm();
  result.after = left_after.squaredNorm();
  return result;
}

}  // namespace torquescope
