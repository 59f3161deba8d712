#include "engine/infer/decision/loop_stage.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/infer/decision/loop_ladder.hpp"
#include "engine/infer/decision/loop_moves.hpp"
#include "engine/infer/decision/loop_tracks.hpp"

namespace torquescope {
namespace {

// least squares of the rows, which missing physics bends: no joint is driven by its friction or has no inertia
Eigen::VectorXd possible_start(Regressor const& regressor, std::vector<FittedNumber> const& fitted,
                               JointScales const& scales) {
  Eigen::VectorXd start(static_cast<Eigen::Index>(regressor.size()));
  Eigen::Index at = 0;
  for (auto const* term : regressor.terms())
    for (std::size_t k = 0; k < term->n_linear(); ++k, ++at) {
      double& value = start[at];
      value = fitted[static_cast<std::size_t>(at)].value;
      if (term->name() == "inertia" && !(value > 0.0)) value = bound_value({0.1, RelativeTo::inertia}, scales);
      if (term->name() == "coulomb") value = std::max(value, 0.0);
    }
  return start;
}

// each recording its share of what is fitted at most
std::vector<RolloutTrack> fitted_stretches(std::vector<RolloutTrack> tracks, DecisionNumbers const& numbers) {
  Eigen::Index all = 0;
  for (auto const& track : tracks) all += track.samples();
  double const share = static_cast<double>(numbers.fitted_samples) / static_cast<double>(all);
  if (share >= 1.0) return tracks;
  for (auto& track : tracks) {
    auto const most = static_cast<Eigen::Index>(share * static_cast<double>(track.samples()));
    track = in_stretches(std::move(track), most);
  }
  return tracks;
}

}  // namespace

LoopFacts decide_in_loop(DecisionQuestion const& question, JointDecision const& scan, LoopOptions const& loop) {
  LoopFacts facts;
  try {
    LoopTracks const tracks = loop_tracks(question.training, question.validation, loop, question.numbers);
    facts.form = tracks.setting.form;
    facts.loop_error = tracks.loop_error;
    if (tracks.training.empty() || facts.form == LoopForm::none) return facts;
    facts.reason = LoopReason::no_controller;
    bool const is_found = form_of(loop) == LoopForm::identified;
    if (is_found && !(facts.loop_error <= question.numbers.largest_loop_error)) return facts;
    JointScales const& scales = scan.baseline.model->reference().scales;
    Eigen::VectorXd const start = possible_start(question.regressor, scan.facts.baseline_parameters, scales);
    std::vector<RolloutTrack> const stretches = fitted_stretches(tracks.training, question.numbers);
    LoopQuestion asked{
        question.regressor, start,         scales, tracks.setting,        stretches,        tracks.training,
        tracks.validation,  tracks.counts, {},     question.most_effects, question.numbers, question.seed,
        question.threads};
    asked.progress = question.progress;
    asked.moves = drive_moves(tracks.setting, tracks.training, drive_effects_of(DriveEffectKind::profile));
    for (auto& effect : effect_moves(scan.facts, question.regressor, scales, question.numbers))
      asked.moves.push_back(std::move(effect));
    double const loop_error = facts.loop_error;
    facts = climb_ladder(asked).facts;
    facts.loop_error = loop_error;
  } catch (Error const&) {
    // a recording with no stretch long enough to be simulated
  }
  return facts;
}

}  // namespace torquescope
