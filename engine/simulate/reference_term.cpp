#include "engine/simulate/reference_term.hpp"

#include <algorithm>
#include <cmath>

namespace torquescope {

double ReferenceSignal::operator()(Eigen::Index k) const {
  Eigen::Index const n = r_.size();
  if (k < 0) return 2.0 * r_[0] - r_[std::min(-k, n - 1)];
  if (k >= n) return 2.0 * r_[n - 1] - r_[std::max(2 * (n - 1) - k, Eigen::Index{0})];
  return r_[k];
}

double ReferenceTerm::operator()(ReferenceSignal const& reference, Eigen::Index k) const {
  switch (shape) {
    case ReferenceShape::sine:
      return std::sin(reference(k + ahead));
    case ReferenceShape::cosine:
      return std::cos(reference(k + ahead));
    case ReferenceShape::smooth_sign:
      break;
  }
  double const slope = (reference(k + ahead) - reference(k + ahead - span)) / span;
  return std::tanh(slope / width);
}

}  // namespace torquescope
