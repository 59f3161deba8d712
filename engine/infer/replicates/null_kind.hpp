#pragma once
// What chance is taken for: replicates, or for ablations one of the textbook nulls, made of the residual itself.
//
// Twins      the method (twin_batch.hpp)
// iid        white normal noise of the residual's variance: the null of an F-test
// hac        residual times a moving average of independent normal numbers, so that the covariance of any statistic
//            over draws is its Newey-West estimate, Bartlett weights, lags by Andrews' rule
// surrogate  the residual's amplitude spectrum with random phases
// Draws      stand where residuals of replicates stand, less what the model fits in them; rows counted without gaps
// Random     addressed by (seed, null, draw): same bits for any number of threads
// Source     Newey, West 1987, doi:10.2307/1913610; Andrews 1991, doi:10.2307/2938229; Shao 2010,
//            doi:10.1198/jasa.2009.tm08744 (dependent wild bootstrap); Theiler et al. 1992,
//            doi:10.1016/0167-2789(92)90102-S (surrogates)

#include <cstdint>
#include <string>
#include <vector>

#include "engine/infer/replicates/mismatch_rows.hpp"

namespace torquescope {

enum class NullKind { twins, iid, hac, surrogate };

std::vector<std::string> null_words();      // of a job file, in the order above
NullKind null_of(std::string const& word);  // word is one of them

// draws in place of the twins' residuals and fits; of NullKind::twins: nothing changes
// Requires   a comparison that did not run away
void replace_null(TwinComparison& comparison, NullKind kind, std::uint64_t seed, int threads);

}  // namespace torquescope
