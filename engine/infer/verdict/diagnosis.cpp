#include "engine/infer/verdict/diagnosis.hpp"

#include <algorithm>

#include "engine/effects/effect.hpp"
#include "engine/effects/effect_traits.hpp"

namespace torquescope {

std::string word(Verdict verdict) {
  switch (verdict) {
    case Verdict::none:
      return "none";
    case Verdict::named:
      return "named";
    case Verdict::one_of_class:
      return "class";
    case Verdict::partly:
      return "partly";
    case Verdict::unexplained:
      return "unexplained";
    case Verdict::insufficient:
      return "insufficient";
    case Verdict::data_fault:
      return "data_fault";
  }
  return {};
}

bool names_physics(Verdict verdict) {
  return verdict == Verdict::named || verdict == Verdict::one_of_class || verdict == Verdict::partly;
}

std::string word(Decision decision) {
  switch (decision) {
    case Decision::named:
      return "named";
    case Decision::equivalent:
      return "class";
    case Decision::measurement:
      return "measurement";
    case Decision::rejected:
      return "no";
    case Decision::not_tested:
      return "not tested";
  }
  return {};
}

NamedEffect named_after(Effect const& effect) {
  NamedEffect named;
  named.name = effect.name();
  named.family = word(effect.family());
  named.title = effect.title();
  named.equation = effect.equation();
  named.acts_on = word(effect.acts_on());
  return named;
}

bool comes_before_motion(NamedEffect const& effect) {
  Effect const* known = find_effect(effect.name);
  return known && known->is_torque_timing() && !effect.parameters.empty() && effect.parameters[0].value < 0.0;
}

bool is_fault(NamedEffect const& effect) {
  bool const acts_on_a_channel = !effect.acts_on.empty() && effect.acts_on != word(ActsOn::joint);
  return acts_on_a_channel && !comes_before_motion(effect) &&
         std::none_of(effect.equivalent.begin(), effect.equivalent.end(), [](auto const& name) {
           Effect const* known = find_effect(name);
           return known && known->acts_on() == ActsOn::joint;
         });
}

std::string which_joint(JointDiagnosis const& joint) {
  return joint.name.empty() ? "joint " + std::to_string(joint.joint) : "the joint of " + joint.name;
}

Verdict verdict_of_arm(std::vector<JointDiagnosis> const& joints, std::vector<NamedEffect> const& of_the_arm) {
  auto const any = [&](Verdict verdict) {
    return std::any_of(joints.begin(), joints.end(), [&](auto const& joint) { return joint.verdict == verdict; });
  };
  bool const has_riddle = any(Verdict::unexplained) || any(Verdict::data_fault) || any(Verdict::partly);
  bool const arm_has_class =
      std::any_of(of_the_arm.begin(), of_the_arm.end(), [](NamedEffect const& one) { return !one.equivalent.empty(); });
  bool const has_class = any(Verdict::one_of_class) || arm_has_class;
  bool const has_name = any(Verdict::named) || !of_the_arm.empty();
  if (any(Verdict::partly) || ((has_class || has_name) && has_riddle)) return Verdict::partly;
  if (has_class) return Verdict::one_of_class;
  if (has_name) return Verdict::named;
  for (Verdict const verdict : {Verdict::unexplained, Verdict::data_fault, Verdict::none})
    if (any(verdict)) return verdict;
  return Verdict::insufficient;
}

}  // namespace torquescope
