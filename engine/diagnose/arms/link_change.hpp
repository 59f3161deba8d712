#pragma once
// The instant from which an arm's links are others: a load was picked up, or let go.
//
// How        before and after every scanned instant the links are fitted on their own, the frictions together, on every
//            other block of time; the blocks between are predicted. Taken where this halves the error of a joint and
//            raises none, against frictions that change instead: a gear that warms up is no load
// Instant    where the two sets of links meet best, to a sample
// Not told   a change in the first or last fifth, or a second one
// Units      SI
// Threads    pure function

#include <optional>

#include "engine/diagnose/arms/setup_search.hpp"

namespace torquescope {

struct LinkChange {
  double time_s = 0.0, end_s = 0.0;  // the recording's last sample
  std::size_t recording = 0;         // of those with samples
  Eigen::VectorXd before, after;     // [N] errors on held-out blocks
};

// of the recording in which it is clearest
std::optional<LinkChange> find_link_change(ArmSamples const& samples, SerialChain const& chain,
                                           SetupNumbers const& numbers = {});

}  // namespace torquescope
