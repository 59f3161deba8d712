#pragma once
// What chance does: replicates of one model, fitted and searched as the recordings are.
//
// Draws      three for each replicate that is wanted. One that leaves more than the recording does, without any noise,
//            is no replicate of it; where too few are left, those that leave least stand for them
// Noise      of rows: what the recording leaves beyond the replicates, with its spectrum (row_noise.hpp), and beside
//            the effect in question: an effect that is missing is no noise
// Enough     the effect that may come out first has done so and no replicate reached it; or of no open or doubted
//            effect, and of no smooth function, p may still come to either side of alpha (Besag, Clifford 1991,
//            doi:10.1093/biomet/78.2.301)
// Threads    spreads replicates over the threads of the question; same bits for any number
// Source     engine/infer/decision/THEORY.md, Chance

#include <cstdint>
#include <vector>

#include "engine/infer/decision/chance.hpp"
#include "engine/infer/decision/fitted_model.hpp"
#include "engine/infer/decision/replicate_strips.hpp"
#include "engine/infer/decision/smooth_correction.hpp"

namespace torquescope {

struct ReplicateGains {
  Chance chance{};
  Chance corrections{};          // of smooth functions (smooth_correction.hpp)
  std::vector<double> delays{};  // D of the delay that a replicate seems to have (delay_decision.hpp)
  ReplicateSource source = ReplicateSource::measured_motion;
  Eigen::MatrixXd left{};  // [rows of the first recording][replicates] residuals
};

// of each question
struct AskedEffects {
  std::vector<bool> open{};      // nothing is known to speak against it
  std::vector<bool> nameable{};  // fitted, and nothing but chance can speak against it
  std::vector<bool> doubted{};   // bounds or judged rows do: beyond chance, it makes the model inadequate
};

// of one step of the search
struct ReplicateTask {
  FittedModel const& model;
  Eigen::VectorXd const& noise;  // [rows] residual whose spectrum the noise has
  Eigen::VectorXd const& gains;  // of the recording, one for each question
  AskedEffects const& asked;
  SmoothCorrections const& corrections;  // of the recording beside the model
  FoldKind kind = FoldKind::whole;
  std::uint32_t step = 0;
};

// effects: is_same_for_all is found here
ReplicateGains replicate_gains(DecisionQuestion const& question, ReplicateTask const& task,
                               std::vector<EffectQuestion>& effects);

}  // namespace torquescope
