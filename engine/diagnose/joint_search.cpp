#include "engine/diagnose/joint_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/infer/search/detection_power.hpp"

namespace torquescope {
namespace {

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

JointSearchAnswer searched(JointQuestion const& question, Recording const& recording, OwnedRecordings const& others,
                           ReversalRows reversals) {
  SearchedJoint joint{std::make_unique<Recording>(recording), others};
  StageSetting setting = setting_for(question, *joint.recording, joint.others, reversals);
  joint.too_short = leave_out_unjudged(setting, joint.others);
  auto why = verdict_of(Verdict::insufficient, [&]() -> std::optional<Hopeless> {
    joint.search =
        search_in_time(setting, *joint.recording, joint.others, {selection_for(question, recording), question.levels},
                       joint.torque_late_s, question.progress);
    return std::nullopt;
  });
  if (!why) joint.kept = keep_what_predicts(*joint.search, joint.others.others());
  return {std::move(joint), std::move(why)};
}

}  // namespace

double visible_share(ModelStage const& baseline, double unseen_floor) {
  return std::max(smallest_visible_share(baseline), std::isfinite(unseen_floor) ? unseen_floor : 0.0);
}

JointSearchAnswer search_joint(JointQuestion const& question, Recording const& recording,
                               OwnedRecordings const& others) {
  ReversalRows const asked = question.input.reversals;
  JointSearchAnswer first =
      searched(question, recording, others, asked == ReversalRows::weigh ? ReversalRows::weigh : ReversalRows::mask);
  if (!first.why || asked != ReversalRows::both || !question.has_reference) return first;
  JointSearchAnswer weighed = searched(question, recording, others, ReversalRows::weigh);
  return weighed.why ? std::move(first) : std::move(weighed);
}

}  // namespace torquescope
