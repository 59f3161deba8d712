#include "engine/infer/pipeline/echoed_reference.hpp"

#include "engine/data/encoder_step.hpp"

namespace torquescope {
namespace {

bool is_white(Eigen::VectorXd const& signal) {
  constexpr Eigen::Index rows = 64, fewest_means = 8;
  constexpr double of_white = 2.0;
  Eigen::Index const n = signal.size() / rows;
  if (n < fewest_means) return false;
  Eigen::VectorXd const inner = signal.head(n * rows).array() - signal.head(n * rows).mean();
  Eigen::VectorXd const means = inner.reshaped(rows, n).colwise().mean();
  return means.squaredNorm() / static_cast<double>(n) * rows <=
         of_white * inner.squaredNorm() / static_cast<double>(n * rows);
}

}  // namespace

bool has_echoed_reference(Recording const& recording) {
  if (recording.position.size() == 0 || recording.reference.size() != recording.position.size()) return false;
  Eigen::VectorXd const apart = recording.reference - recording.position;
  return apart.cwiseAbs().maxCoeff() <= encoder_step(recording) || is_white(apart);
}

Recording without_echoed_reference(Recording recording) {
  if (has_echoed_reference(recording)) recording.reference.resize(0);
  return recording;
}

}  // namespace torquescope
