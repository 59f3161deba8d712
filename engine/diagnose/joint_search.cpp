#include "engine/diagnose/joint_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/infer/search/detection_power.hpp"

namespace torquescope {
namespace {

bool is_named(KeptModel const& kept) {
  return !kept.state.selection.accepted.empty() && kept.is_held_out_lower && kept.state.adequacy.holds();
}

// effects that this joint can have, and its motion can tell
SelectionOptions selection_for(JointQuestion const& question, Recording const& recording) {
  SelectionOptions selection = question.input.selection;
  std::erase_if(selection.candidates, [&](Effect const* law) {
    bool const is_unknown = law->is_given() && !(recording.given && recording.given->of(law->name()));
    return is_unknown || closes(question.first_look.limits(), *law);
  });
  return selection;
}

StageSetting setting_for(JointQuestion const& question, Recording const& recording, OwnedRecordings const& others,
                         ReversalRows reversals) {
  DiagnosisInput const& input = question.input;
  StageSetting setting{
      recording,    question.first_look.regressor(), input.filter, input.filter_section, input.twins, input.seed,
      input.threads};
  setting.ablation = input.ablation;
  setting.reversals = reversals;
  setting.exchange = input.exchange;
  setting.trained = std::make_shared<TrainedMotion const>(trained_motion_of(setting, others.others().training));
  return setting;
}

// recordings to predict of which hardly a row can be judged; their names
std::vector<std::string> leave_out_unjudged(StageSetting const& setting, OwnedRecordings& others) {
  std::vector<std::string> names;
  auto const first = others.all.begin() + static_cast<std::ptrdiff_t>(others.training);
  others.all.erase(std::remove_if(first, others.all.end(),
                                  [&](Recording const& one) {
                                    if (judged_rows(setting, one) >= fewest_rows) return false;
                                    names.push_back(one.name);
                                    return true;
                                  }),
                   others.all.end());
  return names;
}

// setting: of the joint's recording
JointSearchAnswer searched(JointQuestion const& question, SearchedJoint joint, StageSetting setting,
                           SelectionOptions const& selection) {
  auto why = verdict_of(Verdict::insufficient, [&]() -> std::optional<Hopeless> {
    joint.search = search_in_time(setting, *joint.recording, joint.others, {selection, question.levels},
                                  joint.torque_late_s, question.progress);
    return std::nullopt;
  });
  if (!why) joint.kept = keep_what_predicts(*joint.search, joint.others.others());
  return {std::move(joint), std::move(why)};
}

JointSearchAnswer first_search(JointQuestion const& question, Recording const& recording, OwnedRecordings const& others,
                               ReversalRows reversals) {
  SearchedJoint joint{std::make_unique<Recording>(recording), others};
  StageSetting const setting = setting_for(question, *joint.recording, joint.others, reversals);
  joint.too_short = leave_out_unjudged(setting, joint.others);
  return searched(question, std::move(joint), setting, selection_for(question, recording));
}

// Whether the rows between reversals left nothing to explain, in a loop that is known: a loop of our own says nothing
// of reversals
bool asks_for_reversals(JointQuestion const& question, SearchedJoint const& found) {
  auto const& first = found.search->states.front();
  return question.input.reversals == ReversalRows::both && found.search->setting.reversals != ReversalRows::weigh &&
         first.adequacy.holds() && !is_named(found.kept) &&
         first.selection.baseline->twin->loop.source != LoopSource::tracking;
}

JointSearchAnswer search_at_reversals(JointQuestion const& question, SearchedJoint const& found) {
  SearchedJoint again{std::make_unique<Recording>(*found.recording), found.others, found.torque_late_s,
                      found.too_short};
  StageSetting setting = setting_for(question, *again.recording, again.others, ReversalRows::weigh);
  setting.loop = found.search->setting.loop;
  SelectionOptions selection = selection_for(question, *again.recording);
  selection.only_a_mismatch = true;
  return searched(question, std::move(again), setting, selection);
}

// for a name; where the rows between reversals could not have shown much, also for what nothing explains
bool shows_more(JointQuestion const& question, SearchedJoint const& again, SearchedJoint const& found) {
  if (is_named(again.kept)) return true;
  double const visible = visible_share(*found.kept.state.selection.baseline, floor_of(found.kept.held_out));
  return visible >= question.levels.tolerance && !again.search->states.front().adequacy.holds();
}

}  // namespace

double visible_share(ModelStage const& baseline, double unseen_floor) {
  return std::max(smallest_visible_share(baseline), std::isfinite(unseen_floor) ? unseen_floor : 0.0);
}

JointSearchAnswer search_joint(JointQuestion const& question, Recording const& recording,
                               OwnedRecordings const& others) {
  bool const may_weigh = question.input.reversals == ReversalRows::both;
  ReversalRows const rows = question.input.reversals == ReversalRows::weigh ? ReversalRows::weigh : ReversalRows::mask;
  JointSearchAnswer first = first_search(question, recording, others, rows);
  if (first.why) {
    if (!may_weigh || !question.has_reference) return first;
    JointSearchAnswer weighed = first_search(question, recording, others, ReversalRows::weigh);
    return weighed.why ? std::move(first) : std::move(weighed);
  }
  if (!asks_for_reversals(question, first.found)) return first;
  JointSearchAnswer again = search_at_reversals(question, first.found);
  return !again.why && shows_more(question, again.found, first.found) ? std::move(again) : std::move(first);
}

}  // namespace torquescope
