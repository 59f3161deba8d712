#include "engine/twin/baseline_correction.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/pipeline/joint_bounds.hpp"
#include "engine/twin/twin_batch.hpp"

namespace torquescope {
namespace {

// a correction does not lead out of what a joint can have: the fit is within (joint_fit.hpp)
void keep_possible(Eigen::VectorXd& parameters, Eigen::VectorXd const& fit, JointBounds const& bounds) {
  constexpr double most_taken = 0.5;  // of the inertia
  for (Eigen::Index k = 0; k < parameters.size(); ++k)
    if (bounds.non_negative[static_cast<std::size_t>(k)] || k == bounds.friction)
      parameters[k] = std::max(0.0, parameters[k]);
  if (bounds.inertia != JointBounds::none)
    parameters[bounds.inertia] = std::max(parameters[bounds.inertia], most_taken * fit[bounds.inertia]);
  if (!bounds.has_directions()) return;
  double &forward = parameters[bounds.forward], &backward = parameters[bounds.backward];
  if (forward < backward) forward = backward = 0.5 * (forward + backward);
}

}  // namespace

BaselineCorrection correct_baseline(Eigen::VectorXd const& recording_fit, Eigen::VectorXd const& start,
                                    TwinLoop const& loop, TwinTrack const& track, RecordPipeline const& pipeline,
                                    double step_s, TwinAddress const& address, std::size_t twins,
                                    TwinWorkers const& workers) {
  TORQUESCOPE_EXPECT(twins >= 8);
  constexpr int most_rounds = 6;
  constexpr double small_mismatch = 0.2;  // standard deviations
  BaselineCorrection result;
  result.least_squares = recording_fit;
  result.parameters = start;
  auto const n = static_cast<Eigen::Index>(twins);
  Eigen::MatrixXd fits(n, recording_fit.size());
  JointBounds const bounds = joint_bounds(pipeline.model());
  while (result.rounds < most_rounds && !result.converged) {
    CleanTwin const twin(pipeline.model().twin_joint(result.parameters), loop, track, step_s);
    result.ran_away =
        gather_twins(twin, pipeline, address, {0, twins}, workers, {row_each(fits)}, [&](VisitedTwin const& visited) {
          fits.row(static_cast<Eigen::Index>(visited.index)) = visited.record.parameters;
        });
    if (result.ran_away) return result;

    Eigen::RowVectorXd const mean = fits.colwise().mean();
    result.std = ((fits.rowwise() - mean).colwise().squaredNorm() / static_cast<double>(n - 1)).cwiseSqrt();
    // the first two rounds go all the way; later ones average out what the twins' rounding makes of every new start
    double const gain = result.rounds < 2 ? 1.0 : 1.0 / static_cast<double>(result.rounds);
    Eigen::VectorXd const mismatch = recording_fit - mean.transpose();
    result.parameters += gain * mismatch;
    keep_possible(result.parameters, recording_fit, bounds);
    ++result.rounds;
    // without noise all twins are one: then rounding is the yardstick
    constexpr double nothing = std::numeric_limits<double>::min();  // a parameter that this joint has not
    Eigen::ArrayXd const yardstick = result.std.array().max(1e-9 * result.parameters.array().abs()).max(nothing);
    result.largest_mismatch = (mismatch.array().abs() / yardstick).maxCoeff();
    // the whole mismatch, not the shortened step: a small gain must not pass for agreement
    result.converged = result.largest_mismatch < small_mismatch;
  }
  return result;
}

}  // namespace torquescope
