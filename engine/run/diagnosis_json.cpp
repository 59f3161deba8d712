#include "engine/run/diagnosis_json.hpp"

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

// below the smallest p that can be counted: the tail of the twins, continued
Json beyond_counting(double p, std::size_t twins) {
  return twins > 0 && p < 1.0 / static_cast<double>(twins + 1) * (1.0 - 1e-9);
}

Json effect_json(NamedEffect const& effect, std::size_t twins) {
  return {{"name", effect.name},
          {"family", effect.family},
          {"acts_on", effect.acts_on},
          {"equivalent", effect.equivalent},
          {"p", number(effect.p)},
          {"p_is_extrapolated", beyond_counting(effect.p, twins)},
          {"q", number(effect.q)},
          {"z", number(effect.z)},
          {"gain",
           {{"train", number(effect.gain.train)},
            {"cv", number(effect.gain.cv)},
            {"validation", number(effect.gain.validation)}}},
          {"region",
           {{"axis", effect.region.axis}, {"from", number(effect.region.from)}, {"to", number(effect.region.to)}}},
          {"parameters", list(effect.parameters, parameter_json)},
          {"sentence", effect.sentence}};
}

Json candidate_json(Candidate const& candidate, std::size_t twins) {
  return {{"name", candidate.name},
          {"family", candidate.family},
          {"decision", word(candidate.decision)},
          {"reason", candidate.reason},
          {"z", number(candidate.z)},
          {"p", number(candidate.p)},
          {"p_is_extrapolated", beyond_counting(candidate.p, twins)},
          {"q", number(candidate.q)},
          {"gain", number(candidate.gain)},
          {"cv_gain", number(candidate.cv_gain)}};
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

Json joint_json(JointDiagnosis const& joint) {
  Json mismatch = Json::array();
  for (auto const& axis : joint.map)
    for (auto const& region : axis.regions) mismatch.push_back(region_json(region));
  auto const effect = [&](NamedEffect const& one) { return effect_json(one, joint.twins); };
  auto const candidate = [&](Candidate const& one) { return candidate_json(one, joint.twins); };
  return {{"joint", joint.joint},
          {"twins", joint.twins},
          {"baseline",
           {{"parameters", list(joint.baseline, parameter_json)},
            {"train_relerr", number(joint.train_relerr)},
            {"validation_relerr", number(joint.validation_relerr)}}},
          {"mismatch", mismatch},
          {"effects", list(joint.effects, effect)},
          {"candidates", list(joint.candidates, candidate)},
          {"augmented",
           {{"train_relerr", number(joint.augmented_train_relerr)},
            {"validation_relerr", number(joint.augmented_validation_relerr)},
            {"floor_relerr", number(joint.floor_relerr)},
            {"parameters", list(joint.augmented, parameter_json)}}},
          {"budget",
           {{"parameter_error", number(joint.budget.parameter_error)},
            {"missing_physics", number(joint.budget.missing_physics)},
            {"unexplained", number(joint.budget.unexplained)},
            {"noise", number(joint.budget.noise)}}},
          {"unexplained", list(joint.unexplained, unexplained_json)},
          {"excitation", list(joint.excitation, advice_json)}};
}

Json finding_json(Finding const& finding) {
  return {{"code", code_of(finding.kind)},  {"grade", grade_word(finding.grade)},
          {"recording", finding.recording}, {"column", finding.column},
          {"rows", finding.count},          {"lines", finding.lines},
          {"text", sentence_of(finding)},   {"cure", cure_of(finding)}};
}

}  // namespace

std::string diagnosis_json(Diagnosis const& diagnosis) {
  Json const document = {{"schema", 1},
                         {"verdict", word(diagnosis.verdict)},
                         {"reason", diagnosis.reason},
                         {"findings", list(diagnosis.findings, finding_json)},
                         {"joints", list(diagnosis.joints, joint_json)}};
  // texts of a job may hold anything: broken UTF-8 is replaced, not refused
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace torquescope
