#include "engine/diagnose/whole_arm_account.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "engine/account/arm_sentences.hpp"
#include "engine/fit/statistics/student_t.hpp"

namespace torquescope {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// "zero_3" of the effect that is joint 3's
std::string name_of(EffectParameter const& parameter, EffectPlace const& effect) {
  return effect.joint ? parameter.name + "_" + std::to_string(*effect.joint + 1) : parameter.name;
}

std::vector<ParameterEstimate> parameters_of(FoundWholeArmEffect const& found) {
  auto const& all = found.effect.effect->parameters();
  double const t = student_t_quantile(normal_quantile_975, static_cast<double>(stretches_per_recording - 1));
  std::vector<ParameterEstimate> parameters;
  for (Eigen::Index i = 0; i < found.values.size(); ++i) {
    auto const& one = all[static_cast<std::size_t>(i)];
    if (!found.is_told[static_cast<std::size_t>(i)]) continue;
    double const value = found.values[i], half = t * found.errors[i];
    parameters.push_back({name_of(one, found.effect), one.unit_revolute, value, value - half, value + half});
  }
  if (!found.time) return parameters;
  double const instants[] = {found.time->from_s, found.time->until_s};
  for (std::size_t k = 0; k < std::size(instants); ++k)
    if (std::isfinite(instants[k]))
      parameters.push_back({all[found.effect.effect->n_linear() + k].name, "s", instants[k], unknown, unknown});
  return parameters;
}

NamedEffect named(FoundWholeArmEffect const& found, WholeArmRecordings const& recordings, double alpha) {
  Effect const& effect = *found.effect.effect;
  NamedEffect made = named_after(effect);
  for (Effect const* other : found.alike) made.equivalent.push_back(other->name());
  made.p = found.p;
  made.q = alpha;
  made.z = found.z;
  made.gain.cv = found.explained;
  made.parameters = parameters_of(found);
  WholeArmFacts facts{
      "", -infinite, infinite, found.before, found.after, found.validation_before, found.validation_after, {}};
  if (found.time) {
    facts.recording = recordings.train[found.time->recording];
    facts.from_s = found.time->from_s;
    facts.until_s = found.time->until_s;
    for (auto const& there : found.validation_times)
      if (there) facts.validation.push_back({recordings.validation[there->recording], there->from_s, there->until_s});
    made.region = {word(SignatureAxis::time), facts.from_s, facts.until_s, "s"};
  }
  made.sentence = whole_arm_sentence(made, facts);
  return made;
}

char const* clause_of(WholeArmReason reason) {
  switch (reason) {
    case WholeArmReason::accepted:
      return "";
    case WholeArmReason::chance:
      return "within chance";
    case WholeArmReason::out_of_bounds:
      return "a parameter at the end of what is plausible";
    case WholeArmReason::not_held_out:
      return "does not make the error on rows left out clearly lower";
    case WholeArmReason::too_small:
      return "lowers the error on rows left out by too little";
    case WholeArmReason::most_is_left:
      return "explains less than half of the mismatch of all joints";
    case WholeArmReason::validation:
      return "makes the error on validation recordings larger";
  }
  return "";
}

std::string name_of(EffectPlace const& effect) {
  return effect.effect->name() + (effect.joint ? "_" + std::to_string(*effect.joint + 1) : "");
}

Candidate candidate_of(FoundWholeArmEffect const& found, double alpha) {
  Candidate one;
  one.name = name_of(found.effect);
  one.family = word(found.effect.effect->family());
  one.z = found.z;
  one.p = found.p;
  one.q = alpha;
  one.cv_gain = found.explained;
  one.reason = clause_of(found.reason);
  return one;
}

void mark(std::vector<Candidate>& candidates, FoundWholeArmEffect const& accepted) {
  for (Candidate& one : candidates) {
    if (one.name == name_of(accepted.effect)) one.decision = Decision::named;
    for (Effect const* other : accepted.alike)
      if (one.name.starts_with(other->name())) one.decision = Decision::equivalent;
  }
}

}  // namespace

WholeArmDiagnosis account_for_whole_arm(std::vector<WholeArmAnswer> const& answers,
                                        WholeArmRecordings const& recordings, double alpha) {
  WholeArmDiagnosis made;
  for (WholeArmAnswer const& answer : answers) {
    if (made.candidates.empty() || !answer.accepted.empty()) {
      made.candidates.clear();
      for (auto const& one : answer.tried) made.candidates.push_back(candidate_of(one, alpha));
    }
    for (auto const& one : answer.accepted) {
      made.effects.push_back(named(one, recordings, alpha));
      mark(made.candidates, one);
    }
  }
  return made;
}

void credit_effects_of_whole_arm(std::vector<WholeArmAnswer> const& answers, double most,
                                 std::vector<JointDiagnosis>& joints) {
  for (auto const& answer : answers)
    for (auto const& effect : answer.accepted)
      for (std::size_t j = 0; j < joints.size(); ++j) {
        double const share = effect.explained_at[static_cast<Eigen::Index>(j)];
        if (joints[j].verdict != Verdict::unexplained || share <= most) continue;
        joints[j].verdict = Verdict::partly;
        joints[j].explained_share = share;
        joints[j].reason = explained_by_arm_sentence(effect.effect.effect->name(), share) + " " + joints[j].reason;
      }
}

}  // namespace torquescope
