#include "engine/account/excitation_advice.hpp"

#include <algorithm>
#include <cmath>

#include "engine/effects/effect.hpp"

namespace torquescope {

namespace {

constexpr std::size_t enough_motions = 2;  // nobody records twenty

}  // namespace

std::vector<ExcitationAdvice> advice_for(std::vector<NamedEffect> const& effects) {
  std::vector<ExcitationAdvice> advice;
  for (auto const& effect : effects) {
    if (effect.equivalent.empty()) continue;
    ExcitationAdvice one;
    one.would_separate.push_back(effect.name);
    one.would_separate.insert(one.would_separate.end(), effect.equivalent.begin(), effect.equivalent.end());
    std::size_t said = 0;
    for (auto const& name : one.would_separate) {
      if (said == enough_motions) break;
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

std::vector<std::string> closest_of(std::vector<Candidate> const& candidates) {
  auto const share = [](Candidate const& one) { return std::isfinite(one.cv_gain) ? one.cv_gain : -HUGE_VAL; };
  auto const closest = std::max_element(candidates.begin(), candidates.end(),
                                        [&](auto const& a, auto const& b) { return share(a) < share(b); });
  if (closest == candidates.end() || !(share(*closest) > 0.0)) return {};
  return {closest->name};
}

std::vector<ExcitationAdvice> advice_to_confirm(std::vector<std::string> const& names) {
  std::vector<ExcitationAdvice> advice;
  for (auto const& name : names) {
    Effect const* known = find_effect(name);
    if (known && !known->separated_by().empty() && advice.size() < enough_motions)
      advice.push_back({known->separated_by(), {name}});
  }
  return advice;
}

}  // namespace torquescope
