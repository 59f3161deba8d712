#include "engine/infer/decision/servo_spread.hpp"

#include <cmath>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace {

// the model itself, then replicates whose encoders lie elsewhere and which begin elsewhere within a step
std::vector<RolloutTrial> with_replicates(RolloutTrial const& trial, double encoder_step, RandomKey const& key) {
  std::vector<RolloutTrial> trials(replicate_lanes, trial);
  for (std::uint32_t lane = 1; lane < replicate_lanes; ++lane) {
    RandomStream random(key, 0, lane);
    trials[lane].encoder_step = encoder_step;
    trials[lane].encoder_phase = encoder_step * (random.uniform() - 0.5);
    trials[lane].position_step = encoder_step * (random.uniform() - 0.5);
  }
  return trials;
}

}  // namespace

ServoFit servo_fit(ServoQuestion const& question, ServoDecision const& decision) {
  RolloutModel const model = decision.model(question, decision.final);
  RolloutTask task{question.training, {}, {true, false}};
  std::vector<std::vector<RolloutTrial>> trials;
  for (std::size_t t = 0; t < question.training.size(); ++t) {
    auto const& track = question.training[t];
    task.structures.push_back(model.structure_for(model.start(), track.tick_s()));
    trials.push_back(with_replicates(model.trial(model.start()), track.encoder_step,
                                     {question.seed, static_cast<std::uint32_t>(t), RandomDomain::simulation}));
  }
  double left = 0.0, apart = 0.0, samples = 0.0, compared = 0.0;
  for (auto const& track : residuals_of(task, trials, question.threads)) {
    Eigen::MatrixXd const& rows = track.samples[0];
    left += rows.col(0).squaredNorm();
    samples += static_cast<double>(rows.rows());
    for (Eigen::Index lane = 1; lane < rows.cols(); ++lane) {
      double const squares = (rows.col(lane) - rows.col(0)).squaredNorm();
      if (!std::isfinite(squares)) continue;
      apart += squares;
      compared += static_cast<double>(rows.rows());
    }
  }
  return {samples > 0.0 ? std::sqrt(left / samples) : 0.0, compared > 0.0 ? std::sqrt(apart / compared) : 0.0,
          decision.recorded.encoder_step};
}

}  // namespace torquescope
