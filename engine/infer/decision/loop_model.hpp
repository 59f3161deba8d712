#pragma once
// A joint in its loop with some moves made: what a ladder fits, and what it leaves of the recordings.
//
// Moves      each an effect of the catalogue or a number of the loop; a model holds places in the question's moves
// Warm       a model with one more move begins where its parent came to rest, the new numbers at a start of the move
// Threads    plain records, pure functions; looks into the question, which outlives all

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/effects/regressor.hpp"
#include "engine/infer/decision/decision_numbers.hpp"
#include "engine/infer/decision/loop_facts.hpp"
#include "engine/simulate/rollout/rollout_fit.hpp"

namespace torquescope {

struct LoopMove {
  LoopSubject subject{};
  std::vector<std::vector<double>> starts{};  // shapes of the effect, or the numbers of one of the drive; at least one
  double least = 0.0;                         // a first number of less is no name
};

struct LoopQuestion {
  Regressor const& regressor;
  Eigen::VectorXd const& start;  // of the regressor's parameters
  JointScales const& scales;
  LoopSetting const& loop;
  std::vector<RolloutTrack> const& fitted;    // of long recordings stretches
  std::vector<RolloutTrack> const& training;  // all of it
  std::vector<RolloutTrack> const& validation;
  CountedChannels counts{true, true};
  std::vector<LoopMove> moves{};
  std::size_t most_moves = 5;
  DecisionNumbers numbers{};
  std::uint64_t seed = 0;
  int threads = 1;
  bool fits_starts = true;  // what each recording has of its own (fit_unknowns.hpp)
  std::function<void(char const* stage, std::size_t done, std::size_t total)> progress{};
};

// everything that a RolloutModel is made of, and so a point of its parameters
struct LoopPoint {
  Eigen::VectorXd terms;
  std::vector<ModelEffect> effects{};
  LoopSetting loop{};
  Eigen::VectorXd starts{};  // nuisances of the training tracks
  std::vector<std::size_t> moves{};

  RolloutModel model(LoopQuestion const& question) const;
};

LoopPoint base_point(LoopQuestion const& question);
// linear parameters of an effect begin at zero
LoopPoint with_move(LoopQuestion const& question, LoopPoint point, std::size_t move, std::vector<double> const& start);
LoopPoint without_move(LoopQuestion const& question, LoopPoint const& point, std::size_t move);

struct LoopFit {
  LoopPoint point;  // where it came to rest
  RolloutFit fit;
  LoopErrors train{}, validation{};

  LoopErrors const& judged(LoopQuestion const& question) const {
    return question.validation.empty() ? train : validation;
  }
};

// how far a fit is followed
enum class LoopSearch { a_look, a_little, to_its_end };
// a fit that is `failed` holds the point that it began at. Errors only of those followed to their end
LoopFit fitted(LoopQuestion const& question, LoopPoint const& from, LoopSearch search = LoopSearch::to_its_end,
               int threads = 1);
// to its end from where a fit stands; one at rest needs the last pass alone
LoopFit followed(LoopQuestion const& question, LoopFit const& fit, int threads = 1);

// over all samples of training, whatever was fitted
LoopErrors training_errors(LoopQuestion const& question, LoopFit const& fit);

// its numbers with their intervals, which no fit has by itself
LoopFit with_intervals(LoopQuestion const& question, LoopFit fit, int threads);

// D of the larger model; n_eff of its residual
double gain_of(LoopFit const& smaller, LoopFit const& larger, CountedChannels const& counts);
// numbers of a move, or of the whole model
std::vector<LoopNumber> numbers_of(LoopQuestion const& question, LoopFit const& fit,
                                   std::optional<std::size_t> move = {});
// whether the gain over the fit without a move hangs on one of its numbers being at the end of its range, or an effect
// is another there than its name says
bool is_at_bound(LoopQuestion const& question, LoopFit const& without, LoopFit const& fit, std::size_t move);

}  // namespace torquescope
