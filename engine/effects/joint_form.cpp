#include "engine/effects/joint_form.hpp"

#include <algorithm>

namespace torquescope {

std::optional<JointForm> joint_form(Regressor const& regressor) {
  JointForm form{regressor.names(), regressor.units(), {}};
  auto const positive = std::find(form.names.begin(), form.names.end(), "coulomb_positive");
  auto const negative = std::find(form.names.begin(), form.names.end(), "coulomb_negative");
  if (positive == form.names.end() || negative == form.names.end()) return std::nullopt;

  // friction stands where coulomb_positive stood, the offset where coulomb_negative stood
  auto const p = positive - form.names.begin();
  auto const n = negative - form.names.begin();
  auto const size = static_cast<Eigen::Index>(regressor.size());
  form.map = Eigen::MatrixXd::Identity(size, size);
  form.map(p, p) = 0.5;
  form.map(p, n) = -0.5;
  form.map(n, p) = 0.5;
  form.map(n, n) = 0.5;
  *positive = "coulomb";
  *negative = "offset";
  return form;
}

}  // namespace torquescope
