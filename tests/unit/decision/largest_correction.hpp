#pragma once
// The smooth function that gains most beside the terms of a joint, on recordings that are given.

#include <vector>

#include "engine/infer/decision/fitted_model.hpp"
#include "engine/infer/decision/smooth_correction.hpp"
#include "unit/decision/plants.hpp"

namespace torquescope::test {

struct LargestCorrection {
  SignatureAxis axis = SignatureAxis::position;
  double gain = 0.0, rms = 0.0;
};

inline LargestCorrection largest_correction(std::vector<Recording> const& training) {
  Regressor const terms = joint_terms();
  FilterOptions const filter = ten_hertz();
  Section const section{};
  JointStrips const rows = joint_strips({training, {}, terms, filter, section});
  FittedModel const model = fitted_model(rows, terms, {}, nullptr, {DelaySearch::everywhere, 0.15});
  SmoothCorrections const all =
      smooth_corrections(*model.fitted, {model.fitted->base(), model.fitted->residual(), model.fitted->guard()});
  Eigen::Index most = 0;
  all.gains.maxCoeff(&most);
  return {all.axes[static_cast<std::size_t>(most)], all.gains[most], all.rms[most]};
}

}  // namespace torquescope::test
