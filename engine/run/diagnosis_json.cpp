#include "engine/run/diagnosis_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/health/finding_text.hpp"

namespace torquescope {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

// a list of one object per element
template <class Elements, class Make>
Json list(Elements const& elements, Make&& make) {
  Json made = Json::array();
  for (auto const& element : elements) made.push_back(make(element));
  return made;
}

Json parameter_json(ParameterEstimate const& parameter) {
  return {{"name", parameter.name},
          {"value", number(parameter.value)},
          {"unit", parameter.unit},
          {"ci95", Json::array({number(parameter.lower), number(parameter.upper)})}};
}

Json region_json(MismatchRegion const& region) {
  return {{"axis", region.where.axis},
          {"from", number(region.where.from)},
          {"to", number(region.where.to)},
          {"unit", region.where.unit},
          {"time_share", number(region.time_share)},
          {"energy_share", number(region.energy_share)},
          {"repeatable_share", number(region.repeatable_share)}};
}

// p as the screen, the page and the Python reader have it: no replicate reached it where it is a bound, and below that
// bound there is only their tail, continued
void add_p(Json& to, double p, bool is_bound, std::size_t replicates) {
  double const least = least_p(replicates);
  to["p"] = number(std::max(p, least));
  to["p_is_bound"] = is_bound || p <= least * (1.0 + 1e-9);
  to["p_extrapolated"] = number(p);
}

Json effect_json(NamedEffect const& effect, std::size_t replicates) {
  Json made = {
      {"name", effect.name}, {"family", effect.family}, {"acts_on", effect.acts_on}, {"equivalent", effect.equivalent}};
  add_p(made, effect.p, effect.p_is_bound, replicates);
  made.update({{"q", number(effect.q)},
               {"z", number(effect.z)},
               {"gain",
                {{"train", number(effect.gain.train)},
                 {"cv", number(effect.gain.cv)},
                 {"validation", number(effect.gain.validation)}}},
               {"region",
                {{"axis", effect.region.axis}, {"from", number(effect.region.from)}, {"to", number(effect.region.to)}}},
               {"parameters", list(effect.parameters, parameter_json)},
               {"sentence", effect.sentence}});
  return made;
}

Json candidate_json(Candidate const& candidate, std::size_t replicates) {
  Json made = {{"name", candidate.name},
               {"family", candidate.family},
               {"decision", word(candidate.decision)},
               {"reason", candidate.reason},
               {"z", number(candidate.z)}};
  add_p(made, candidate.p, false, replicates);
  made.update({{"q", number(candidate.q)}, {"gain", number(candidate.gain)}, {"cv_gain", number(candidate.cv_gain)}});
  return made;
}

Json unexplained_json(UnexplainedPart const& part) {
  return {{"axis", part.where.axis},
          {"from", number(part.where.from)},
          {"to", number(part.where.to)},
          {"energy_share", number(part.energy_share)}};
}

Json advice_json(ExcitationAdvice const& advice) {
  return {{"lacks", advice.lacks}, {"would_separate", advice.would_separate}};
}

Json left_out_json(LeftOut const& left_out) {
  return {{"time_share", number(left_out.time)},
          {"energy_share", number(left_out.energy)},
          {"relerr_all_rows", number(left_out.relerr)},
          {"augmented_relerr_all_rows", number(left_out.augmented_relerr)}};
}

Json held_out_json(HeldOutTest const& test) {
  return {{"rows", test.rows},
          {"change", test.change},
          {"t", number(test.t)},
          {"asked_for", number(test.asked_for)},
          {"blocks", test.blocks}};
}

Json explained_json(JointDiagnosis const& joint) {
  return {{"share", number(joint.explained_share)},
          {"ci95", Json::array({number(joint.explained_low), number(joint.explained_high)})}};
}

Json decision_law_json(DecisionAccount::Law const& law) {
  Json shape = Json::array();
  for (double const one : law.shape) shape.push_back(number(one));
  return {{"name", law.name},
          {"refusal", law.refusal},
          {"gain", number(law.gain)},
          {"gain_by_chance", number(law.level)},
          {"p", number(law.p)},
          {"size", number(law.size)},
          {"judged_before", number(law.judged_before)},
          {"judged_after", number(law.judged_after)},
          {"shape", shape},
          {"rivals", law.rivals}};
}

Json decision_step_json(DecisionAccount::Step const& step) {
  return {{"of_clock", step.of_clock},
          {"replicates", step.replicates},
          {"replicates_from", step.source},
          {"visible", number(step.visible)},
          {"smooth_correction",
           {{"axis", step.correction_axis},
            {"gain", number(step.correction_gain)},
            {"p", number(step.correction_p)},
            {"size", number(step.correction_size)}}},
          {"laws", list(step.laws, decision_law_json)}};
}

Json loop_number_json(DecisionAccount::Number const& of) {
  return {{"name", of.name},
          {"unit", of.unit},
          {"value", number(of.value)},
          {"ci95", Json::array({number(of.lower), number(of.upper)})}};
}

Json loop_move_json(DecisionAccount::Move const& move) {
  return {{"name", move.name},
          {"refusal", move.refusal},
          {"gain", number(move.gain)},
          {"gain_by_chance", number(move.level)},
          {"p", number(move.p)},
          {"error_before", number(move.before)},
          {"error_after", number(move.after)}};
}

Json kept_move_json(DecisionAccount::Move const& move) {
  return {{"name", move.name},
          {"gain", number(move.gain)},
          {"p", number(move.p)},
          {"numbers", list(move.numbers, loop_number_json)},
          {"rivals", move.rivals}};
}

Json rung_json(DecisionAccount::Rung const& rung) {
  return {{"model", rung.model}, {"replicates", rung.replicates}, {"moves", list(rung.moves, loop_move_json)}};
}

Json loop_json(DecisionAccount::Loop const& loop) {
  auto const errors = [](DecisionAccount::Simulated const& of) -> Json {
    return {{"position", number(of.position)}, {"torque", number(of.torque)}};
  };
  return {{"reason", loop.reason},
          {"decides", loop.decides},
          {"controller", loop.controller},
          {"counts_torque", loop.counts_torque},
          {"loop_error", number(loop.loop_error)},
          {"base", {{"train", errors(loop.base_train)}, {"validation", errors(loop.base_validation)}}},
          {"final", {{"train", errors(loop.final_train)}, {"validation", errors(loop.final_validation)}}},
          {"kept", list(loop.kept, kept_move_json)},
          {"numbers", list(loop.numbers, loop_number_json)},
          {"steps", list(loop.steps, rung_json)}};
}

Json decision_json(DecisionAccount const& account) {
  auto const errors = [](DecisionAccount::Errors const& of) -> Json {
    return {{"train", number(of.train)}, {"held_out", number(of.held_out)}, {"validation", number(of.validation)}};
  };
  return {{"verdict", account.verdict},
          {"quiet_share", number(account.quiet_share)},
          {"set_aside_share", number(account.set_aside_share)},
          {"baseline", errors(account.baseline)},
          {"final", errors(account.final)},
          {"accepted", list(account.accepted, decision_law_json)},
          {"delay",
           {{"seconds", number(account.delay.seconds)},
            {"deviation", number(account.delay.deviation)},
            {"gain", number(account.delay.gain)},
            {"p", number(account.delay.p)},
            {"size", number(account.delay.size)},
            {"is_named", account.delay.is_named}}},
          {"loop", loop_json(account.loop)},
          {"steps", list(account.steps, decision_step_json)}};
}

Json joint_json(JointDiagnosis const& joint) {
  Json mismatch = Json::array();
  for (auto const& axis : joint.map)
    for (auto const& region : axis.regions) mismatch.push_back(region_json(region));
  auto const effect = [&](NamedEffect const& one) { return effect_json(one, joint.twins); };
  auto const candidate = [&](Candidate const& one) { return candidate_json(one, joint.twins); };
  Json made = {{"joint", joint.joint}, {"name", joint.name}};
  // of an arm, whose joints have verdicts of their own
  if (!joint.reason.empty()) made.update({{"verdict", word(joint.verdict)}, {"reason", joint.reason}});
  made.update(
      {{"twins", joint.twins},
       {"baseline",
        {{"parameters", list(joint.baseline, parameter_json)},
         {"train_relerr", number(joint.train_relerr)},
         {"validation_relerr", number(joint.validation_relerr)},
         {"cv_relerr", number(joint.cv_relerr)}}},
       {"mismatch", mismatch},
       {"effects", list(joint.effects, effect)},
       {"candidates", list(joint.candidates, candidate)},
       {"augmented",
        {{"train_relerr", number(joint.augmented_train_relerr)},
         {"validation_relerr", number(joint.augmented_validation_relerr)},
         {"cv_relerr", number(joint.augmented_cv_relerr)},
         {"floor_relerr", number(joint.floor_relerr)},
         {"parameters", list(joint.augmented, parameter_json)}}},
       {"left_out",
        {{"train", left_out_json(joint.train_left_out)}, {"validation", left_out_json(joint.validation_left_out)}}},
       {"held_out", held_out_json(joint.held_out)},
       {"explained", explained_json(joint)},
       {"budget",
        {{"parameter_error", number(joint.budget.parameter_error)},
         {"missing_physics", number(joint.budget.missing_physics)},
         {"unexplained", number(joint.budget.unexplained)},
         {"noise", number(joint.budget.noise)}}},
       {"unexplained", list(joint.unexplained, unexplained_json)},
       {"excitation", list(joint.excitation, advice_json)}});
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
                   {"reason", diagnosis.reason},
                   {"findings", list(diagnosis.findings, finding_json)},
                   {"joints", list(diagnosis.joints, joint_json)}};
  if (diagnosis.arm)
    document["arm"] = {
        {"effects", list(diagnosis.arm->effects, [](NamedEffect const& one) { return effect_json(one, 0); })},
        {"candidates", list(diagnosis.arm->candidates, [](Candidate const& one) { return candidate_json(one, 0); })}};
  // texts of a job may hold anything: broken UTF-8 is replaced, not refused
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace torquescope
