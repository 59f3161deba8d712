#pragma once
// The whole catalogue against one model: what each law gains, and how far that is beyond chance.
//
// Gain       of a law the largest over its shape grid, of the recording and of every replicate
// Standard   gain less its mean over replicates, over their spread; of a replicate: against the others
// p          (1 + replicates whose largest standardised gain over the catalogue reaches this one) / (M + 1): the search
//            over laws and shapes is paid for, no tail is extrapolated
// Threads    spreads grid points over `threads`; same bits for any number
// Source     max-T: Westfall, Young 1993, ISBN 978-0-471-55761-6; p: Davison, Hinkley 1997, section 4.2,
//            doi:10.1017/CBO9780511802843

#include <span>
#include <vector>

#include "engine/infer/moving_rows/evidence.hpp"
#include "engine/infer/search/effect_scan.hpp"

namespace torquescope {

struct CandidateEvidence {
  FoldKind folds = FoldKind::whole;  // that the gain is of
  EffectScan scan{};  // effect, grid, best point and shape; z: standardised gain; p: over the catalogue; gain: of both
  double train = 0.0, unseen = 0.0;             // parts of the gain
  double first = 0.0;                           // of train: in the recording that stages are made of
  double least_unseen = 0.0;                    // that replicates lose there by chance (5 %); 0 without unseen evidence
  std::vector<double> null_standard{};          // of replicates
  double first_mean = 0.0, first_spread = 0.0;  // of what replicates gain there
};

struct CatalogueEvidence {
  std::vector<CandidateEvidence> laws{};
  std::vector<double> largest{};  // standardised gain over the catalogue, of each replicate
  double chance = 0.0;            // that 1 - alpha of them stay below
};

CatalogueEvidence scan_catalogue(Evidence const& evidence, std::span<Effect const* const> effects, FoldKind kind,
                                 double alpha, int threads);

}  // namespace torquescope
