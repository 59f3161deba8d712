#include "engine/account/name_list.hpp"

#include <algorithm>

namespace torquescope {

std::string in_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string name_list(std::vector<std::string> const& names, std::string const& last) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " " + last + " " : ", ") + in_words(names[i]);
  return text;
}

std::vector<std::string> names_of(JointDiagnosis const& joint) {
  std::vector<std::string> names;
  for (auto const& effect : joint.effects) names.push_back(effect.name);
  return names;
}

std::ptrdiff_t n_tested(JointDiagnosis const& joint) {
  return std::count_if(joint.candidates.begin(), joint.candidates.end(),
                       [](Candidate const& one) { return one.decision != Decision::not_tested; });
}

}  // namespace torquescope
