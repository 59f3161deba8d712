#pragma once
// Every move beside one model of a joint in its loop: D of one step from each of its starts, in the recording and in
// replicates of the model alike.
//
// One step   of least squares on the plane at a start (loop_tangent.hpp): recording and replicates get the same search,
//            so p is fair, however far the plane is from the fit. The fit of the recording is a second question
// n_eff      of what the model leaves of the recording, in replicates too
// Sign       an effect of one parameter that cannot be negative gains nothing where its step is
// Random     addressed by (seed, step)
// Threads    spreads moves over the question's threads; same bits for any number
// Source     engine/infer/decision/THEORY.md, In the loop

#include <vector>

#include "engine/infer/decision/loop_model.hpp"

namespace torquescope {

struct ScannedMove {
  std::size_t move = 0;
  double gain = 0.0, p = 1.0, level = 0.0;
  std::vector<std::size_t> starts{};  // largest gain first
};

struct LoopScan {
  std::size_t replicates = 0;
  std::vector<ScannedMove> moves{};  // largest gain first
};

// moves: places in the question's; fewer than two replicates: no p
LoopScan scan_moves(LoopQuestion const& question, LoopFit const& model, std::vector<std::size_t> const& moves,
                    std::uint32_t step);

}  // namespace torquescope
