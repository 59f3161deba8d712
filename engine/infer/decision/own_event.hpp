#pragma once
// When an event of the training recording happens in another one, and how large it is there: a load is picked up at
// another time, a hand pushes elsewhere, a channel's zero creeps by another amount.
//
// Equation   the shape on the grid of the effect whose columns explain most of `left`, refined (pattern_search.hpp)
// Null       the same search on replicates: what the event leaves, each stretch as long as the memory of the filter
//            with a random sign, 60 at most. So the freedom of an instant and a size is theirs as well
// Shapes     n rows; L = effect.n_linear()
// Threads    free function; columns_at is called from the caller's thread; same bits always
// Source     wild bootstrap of blocks: Shao 2010, doi:10.1198/jasa.2009.tm08744

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/effects/effect.hpp"

namespace torquescope {

struct EventQuestion {
  Effect const* effect = nullptr;
  JointScales scales{};  // of the recording: its time and duration
  Eigen::Index memory_rows = 1;
  double alpha = 0.01;  // convention: a null without the event makes chance look rarer, up to five times
  std::uint64_t seed = 0;
};

// n x L, one for each shape
using ColumnsOfShapes = std::function<std::vector<Eigen::MatrixXd>(std::vector<std::vector<double>> const&)>;

struct OwnEvent {
  std::vector<double> shape{};
  Eigen::MatrixXd columns{};  // there
};

// nothing where no instant explains more than chance does
std::optional<OwnEvent> own_event(EventQuestion const& question, ColumnsOfShapes const& columns_at,
                                  Eigen::VectorXd const& left);

// the same scales on that time
JointScales scales_during(JointScales scales, Eigen::Ref<Eigen::VectorXd const> const& time_s);

}  // namespace torquescope
