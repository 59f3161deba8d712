#include "engine/diagnose/excitation_advice.hpp"

#include "engine/effects/effect.hpp"

namespace torquescope {

std::vector<ExcitationAdvice> advice_for(std::vector<NamedEffect> const& effects) {
  constexpr std::size_t enough = 2;  // motions: nobody records twenty
  std::vector<ExcitationAdvice> advice;
  for (auto const& effect : effects) {
    if (effect.equivalent.empty()) continue;
    ExcitationAdvice one;
    one.would_separate.push_back(effect.name);
    one.would_separate.insert(one.would_separate.end(), effect.equivalent.begin(), effect.equivalent.end());
    std::size_t said = 0;
    for (auto const& name : one.would_separate) {
      if (said == enough) break;
      Effect const* known = find_effect(name);
      if (!known || known->separated_by().empty()) continue;
      bool const is_said = one.lacks.find(known->separated_by()) != std::string::npos;
      if (is_said) continue;
      one.lacks += (one.lacks.empty() ? "" : "; ") + known->separated_by();
      ++said;
    }
    // terms of the baseline that are one another's sum: no motion tells them apart
    if (!one.lacks.empty()) advice.push_back(std::move(one));
  }
  return advice;
}

}  // namespace torquescope
