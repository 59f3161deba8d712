#include "engine/workflows/results/diagnosis_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/account/job_lines.hpp"
#include "engine/account/verdict_lines.hpp"
#include "engine/data/health/finding_text.hpp"
#include "engine/workflows/results/json_values.hpp"
#include "engine/workflows/results/loop_json.hpp"

namespace torquescope {

namespace {

using Json = nlohmann::ordered_json;

Json parameter_json(ParameterEstimate const& parameter) {
  return {{"name", parameter.name},
          {"value", json_number(parameter.value)},
          {"unit", parameter.unit},
          {"ci95", Json::array({json_number(parameter.lower), json_number(parameter.upper)})}};
}

Json region_json(MismatchRegion const& region) {
  return {{"axis", region.where.axis},
          {"from", json_number(region.where.from)},
          {"to", json_number(region.where.to)},
          {"unit", region.where.unit},
          {"time_share", json_number(region.time_share)},
          {"energy_share", json_number(region.energy_share)},
          {"repeatable_share", json_number(region.repeatable_share)}};
}

// p as the screen, the page and the Python reader have it: no replicate reached it where it is a bound, and below that
// bound there is only their tail, continued
void add_p(Json& to, double p, std::size_t replicates) {
  double const least = least_p(replicates);
  to["p"] = json_number(std::max(p, least));
  to["p_is_bound"] = p <= least * (1.0 + 1e-9);
  to["p_extrapolated"] = json_number(p);
}

Json effect_json(NamedEffect const& effect, std::size_t replicates) {
  Json made = {
      {"name", effect.name}, {"family", effect.family}, {"acts_on", effect.acts_on}, {"equivalent", effect.equivalent}};
  add_p(made, effect.p, replicates);
  made.update({{"q", json_number(effect.q)},
               {"z", json_number(effect.z)},
               {"gain", {{"train", json_number(effect.gain.train)}, {"cv", json_number(effect.gain.cv)}}},
               {"region",
                {{"axis", effect.region.axis},
                 {"from", json_number(effect.region.from)},
                 {"to", json_number(effect.region.to)}}},
               {"parameters", json_list(effect.parameters, parameter_json)},
               {"sentence", effect.sentence}});
  return made;
}

Json candidate_json(Candidate const& candidate, std::size_t replicates) {
  Json made = {{"name", candidate.name},
               {"family", candidate.family},
               {"decision", word(candidate.decision)},
               {"reason", candidate.reason},
               {"z", json_number(candidate.z)}};
  add_p(made, candidate.p, replicates);
  made.update({{"q", json_number(candidate.q)},
               {"gain", json_number(candidate.gain)},
               {"cv_gain", json_number(candidate.cv_gain)}});
  return made;
}

Json unexplained_json(UnexplainedPart const& part) {
  return {{"axis", part.where.axis},
          {"from", json_number(part.where.from)},
          {"to", json_number(part.where.to)},
          {"energy_share", json_number(part.energy_share)}};
}

Json advice_json(ExcitationAdvice const& advice) {
  return {{"lacks", advice.lacks}, {"would_separate", advice.would_separate}};
}

Json decision_effect_json(DecisionAccount::Effect const& effect) {
  Json shape = Json::array();
  for (double const one : effect.shape) shape.push_back(json_number(one));
  return {{"name", effect.name},
          {"refusal", effect.refusal},
          {"gain", json_number(effect.gain)},
          {"gain_by_chance", json_number(effect.level)},
          {"p", json_number(effect.p)},
          {"size", json_number(effect.size)},
          {"judged_before", json_number(effect.judged_before)},
          {"judged_after", json_number(effect.judged_after)},
          {"shape", shape},
          {"rivals", effect.rivals}};
}

Json decision_step_json(DecisionAccount::Step const& step) {
  return {{"of_clock", step.of_clock},
          {"replicates", step.replicates},
          {"replicates_from", step.source},
          {"visible", json_number(step.visible)},
          {"smooth_correction",
           {{"axis", step.correction_axis},
            {"gain", json_number(step.correction_gain)},
            {"p", json_number(step.correction_p)},
            {"size", json_number(step.correction_size)}}},
          {"laws", json_list(step.effects, decision_effect_json)}};
}

Json decision_json(DecisionAccount const& account) {
  auto const errors = [](DecisionAccount::Errors const& of) -> Json {
    return {{"train", json_number(of.train)},
            {"held_out", json_number(of.held_out)},
            {"validation", json_number(of.validation)}};
  };
  return {{"verdict", account.verdict},
          {"quiet_share", json_number(account.quiet_share)},
          {"set_aside_share", json_number(account.set_aside_share)},
          {"smallest_named", json_number(account.smallest_named)},
          {"sticking_length", json_number(account.sticking_length)},
          {"baseline", errors(account.baseline)},
          {"final", errors(account.final)},
          {"accepted", json_list(account.accepted, decision_effect_json)},
          {"delay",
           {{"seconds", json_number(account.delay.seconds)},
            {"deviation", json_number(account.delay.deviation)},
            {"gain", json_number(account.delay.gain)},
            {"p", json_number(account.delay.p)},
            {"size", json_number(account.delay.size)},
            {"is_named", account.delay.is_named}}},
          {"loop", loop_json(account.loop)},
          {"steps", json_list(account.steps, decision_step_json)}};
}

Json joint_json(JointDiagnosis const& joint) {
  Json mismatch = Json::array();
  for (auto const& axis : joint.map)
    for (auto const& region : axis.regions) mismatch.push_back(region_json(region));
  auto const effect = [&](NamedEffect const& one) { return effect_json(one, joint.replicates); };
  auto const candidate = [&](Candidate const& one) { return candidate_json(one, joint.replicates); };
  Json made = {{"joint", joint.joint}, {"name", joint.name}};
  // of an arm, whose joints have verdicts of their own
  if (!joint.reason.empty()) made.update({{"verdict", word(joint.verdict)}, {"reason", joint.reason}});
  made.update({{"twins", joint.replicates},
               {"baseline",
                {{"parameters", json_list(joint.baseline, parameter_json)},
                 {"train_relerr", json_number(joint.train_relerr)},
                 {"validation_relerr", json_number(joint.validation_relerr)},
                 {"cv_relerr", json_number(joint.cv_relerr)}}},
               {"mismatch", mismatch},
               {"effects", json_list(joint.effects, effect)},
               {"candidates", json_list(joint.candidates, candidate)},
               {"augmented",
                {{"train_relerr", json_number(joint.augmented_train_relerr)},
                 {"validation_relerr", json_number(joint.augmented_validation_relerr)},
                 {"cv_relerr", json_number(joint.augmented_cv_relerr)},
                 {"parameters", json_list(joint.augmented, parameter_json)}}},
               {"explained", {{"share", json_number(joint.explained_share)}}},
               {"budget",
                {{"parameter_error", json_number(joint.budget.parameter_error)},
                 {"missing_physics", json_number(joint.budget.missing_physics)},
                 {"unexplained", json_number(joint.budget.unexplained)},
                 {"noise", json_number(joint.budget.noise)}}},
               {"unexplained", json_list(joint.unexplained, unexplained_json)},
               {"excitation", json_list(joint.excitation, advice_json)}});
  if (joint.decision) made["decision"] = decision_json(*joint.decision);
  return made;
}

Json finding_json(Finding const& finding) {
  return {{"code", code_of(finding.kind)},  {"grade", grade_word(finding.grade)},
          {"recording", finding.recording}, {"column", finding.column},
          {"rows", finding.count},          {"lines", finding.lines},
          {"text", sentence_of(finding)},   {"cure", cure_of(finding)}};
}

}  // namespace

std::string diagnosis_json(Diagnosis const& diagnosis) {
  Json document = {{"schema", 1},
                   {"verdict", word(diagnosis.verdict)},
                   {"headline", headline_of(diagnosis)},
                   {"reason", diagnosis.reason},
                   {"findings", json_list(diagnosis.findings, finding_json)},
                   {"joints", json_list(diagnosis.joints, joint_json)}};
  for (std::size_t i = 0; diagnosis.arm && i < diagnosis.joints.size(); ++i)
    document["joints"][i]["job_lines"] = job_lines(diagnosis.joints[i]);
  if (diagnosis.arm)
    document["arm"] = {
        {"effects", json_list(diagnosis.arm->effects, [](NamedEffect const& one) { return effect_json(one, 0); })},
        {"candidates",
         json_list(diagnosis.arm->candidates, [](Candidate const& one) { return candidate_json(one, 0); })}};
  // texts of a job may hold anything: broken UTF-8 is replaced, not refused
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace torquescope
