#pragma once
// What chance is taken for: clean twins, or for the ablations one of the textbook nulls, made of the residual itself.
//
// Twins      the method (twin_batch.hpp)
// iid        white normal noise of the residual's variance: the null of an F-test
// hac        residual times a moving average of independent normal numbers, so that the covariance of any statistic
//            over draws is its Newey-West estimate, Bartlett weights, lags by Andrews' rule: the null of a HAC test
// surrogate  the residual's amplitude spectrum with random phases: the null of a surrogate test
// Draws      stand where the residuals of twins stand, less what the model's columns fit in them; so all that follows
//            (search over shapes, largest statistic, multiple testing) is the same. What processing does to a perfect
//            joint is in none of them: that is what they are here to show
// Rows       counted as if no reversal were left out between them
// Random     addressed by (seed, null, draw): same bits for any number of threads
// Source     Newey, West 1987; Andrews 1991; Shao 2010 (dependent wild bootstrap, whose Bartlett form is this); Theiler
//            et al. 1992 (phase-randomised surrogates)

#include <cstdint>
#include <string>
#include <vector>

#include "engine/twin/mismatch_rows.hpp"

namespace torquescope {

enum class NullKind { twins, iid, hac, surrogate };

std::vector<std::string> null_words();      // of a job file, in the order above
NullKind null_of(std::string const& word);  // word is one of them

// draws in place of the twins' residuals and fits; of NullKind::twins: nothing changes
// Requires   a comparison that did not run away
void replace_null(TwinComparison& comparison, NullKind kind, std::uint64_t seed, int threads);

}  // namespace torquescope
