#include "engine/infer/replicates/baseline_correction.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/infer/pipeline/joint_bounds.hpp"
#include "engine/infer/replicates/twin_batch.hpp"

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

// of parameters, in torque on the recording's rows
struct TorqueNorm {
  Eigen::MatrixXd gram;
  double square(Eigen::VectorXd const& change) const { return change.dot(gram * change); }
};

TorqueNorm norm_on(ProcessedRecord const& recording) { return {inner_products(recording.columns, recording.columns)}; }

struct Scatter {
  Eigen::VectorXd mean{}, std{};
  double energy = 0.0;  // of one fit about the mean
};

Scatter scatter_of(Eigen::MatrixXd const& fits, TorqueNorm const& norm) {
  Scatter result;
  result.mean = fits.colwise().mean().transpose();
  Eigen::MatrixXd const deviations = fits.rowwise() - result.mean.transpose();
  auto const free = static_cast<double>(fits.rows() - 1);
  result.std = (deviations.colwise().squaredNorm() / free).cwiseSqrt().transpose();
  result.energy = (deviations * norm.gram).cwiseProduct(deviations).sum() / free;
  return result;
}

}  // namespace

BaselineCorrection correct_baseline(ProcessedRecord const& recording, Eigen::VectorXd const& start,
                                    TwinLoop const& loop, TwinTrack const& track, RecordPipeline const& pipeline,
                                    double step_s, TwinAddress const& address, std::size_t twins,
                                    TwinWorkers const& workers) {
  TORQUESCOPE_EXPECT(twins >= 8);
  constexpr int most_rounds = 6;
  constexpr double small_mismatch = 0.2, rounding = 1e-9;
  Eigen::VectorXd const& wanted = recording.parameters;
  TorqueNorm const norm = norm_on(recording);
  double const least = rounding * std::sqrt(norm.square(wanted));  // without noise all replicates are one
  BaselineCorrection result;
  result.least_squares = wanted;
  result.parameters = start;
  Eigen::MatrixXd fits(static_cast<Eigen::Index>(twins), wanted.size());
  JointBounds const bounds = joint_bounds(pipeline.model());
  Eigen::VectorXd tried = start;
  while (result.rounds < most_rounds && !result.converged) {
    CleanTwin const twin(pipeline.model().twin_joint(tried), loop, track, step_s);
    result.ran_away =
        gather_twins(twin, pipeline, address, {0, twins}, workers, {row_each(fits)}, [&](VisitedTwin const& visited) {
          fits.row(static_cast<Eigen::Index>(visited.index)) = visited.record.parameters;
        });
    if (result.ran_away) return result;
    Scatter const scatter = scatter_of(fits, norm);
    Eigen::VectorXd const difference = wanted - scatter.mean;
    double const mismatch = std::sqrt(norm.square(difference)) / std::max(std::sqrt(scatter.energy), least);
    if (result.rounds > 0 && mismatch >= result.mismatch) break;
    // the first two rounds go all the way; later ones average out what rounding makes of every new start
    double const gain = result.rounds < 2 ? 1.0 : 1.0 / static_cast<double>(result.rounds);
    result.std = scatter.std;
    result.mismatch = mismatch;
    result.converged = mismatch < small_mismatch;
    ++result.rounds;
    result.parameters = tried;
    tried += gain * difference;
    keep_possible(tried, wanted, bounds);
    if (result.converged) result.parameters = tried;
  }
  return result;
}

}  // namespace torquescope
