#pragma once
// What chance does: replicates of one model, fitted and searched as the recordings are.
//
// Draws      three for each replicate that is wanted. One that leaves more than the recording does, without any noise,
//            is no replicate of it; where too few are left, those that leave least stand for them
// Noise      of rows: what the recording leaves beyond the replicates, with the recording's spectrum (row_noise.hpp)
// Enough     the law that gains most has come out and no replicate reached it; or of no asked or doubted law, and of no
//            smooth function, p may still come to either side of alpha (Besag, Clifford 1991,
//            doi:10.1093/biomet/78.2.301)
// Threads    spreads replicates over the threads of the question; same bits for any number
// Source     engine/decision/THEORY.md, Chance

#include <cstdint>
#include <vector>

#include "engine/decision/chance.hpp"
#include "engine/decision/fitted_model.hpp"
#include "engine/decision/replicate_strips.hpp"

namespace torquescope {

struct ReplicateGains {
  Chance chance{};
  std::vector<double> corrections{};  // D of smooth functions (smooth_correction.hpp)
  std::vector<double> delays{};       // D of the delay that a replicate seems to have (delay_decision.hpp)
  ReplicateSource source = ReplicateSource::measured_motion;
};

// places among the questions: laws that nothing but chance speaks against, the one that gains most first; and those
// that are refused, but make the model inadequate where they are beyond chance
struct AskedLaws {
  std::vector<std::size_t> first{}, doubted{};
};

// questions: is_same_for_all is found here. gains: of the recording, one for each question; step: of the search
ReplicateGains replicate_gains(DecisionQuestion const& question, FittedModel const& model,
                               std::vector<LawQuestion>& questions, Eigen::VectorXd const& gains,
                               AskedLaws const& asked, FoldKind kind, std::uint32_t step);

}  // namespace torquescope
