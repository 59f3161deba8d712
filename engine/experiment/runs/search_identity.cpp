#include "engine/experiment/runs/search_identity.hpp"

#include <set>

#include "engine/base/digest.hpp"

namespace torquescope {
namespace {

Section without(Section section, std::set<std::string> const& keys) {
  std::erase_if(section.settings, [&](Setting const& setting) { return keys.contains(setting.key); });
  return section;
}

void add(Digest& digest, Section const& section) {
  digest.text(section.name);
  for (auto const& setting : section.settings) digest.text(setting.key).text(to_text(setting.value));
}

}  // namespace

std::vector<Section> search_sections(Job const& job) {
  std::vector<Section> sections;
  for (auto const& section : job.sections) {
    if (section.name == "estimator" || section.name == "output" || section.name == "diagnose") continue;
    if (section.name == "experiment")
      sections.push_back(without(section, {"name", "study", "runs"}));
    else if (section.name == "recording")
      sections.push_back(without(section, {"train", "validate"}));
    else
      sections.push_back(section);
  }
  return sections;
}

std::string search_sha256(Experiment::Parts const& parts, EstimatorPlan const& plan) {
  Digest digest;
  for (auto const& section : search_sections(parts.job)) add(digest, section);
  // of the recordings what they hold, wherever they stand
  for (auto const& recording : parts.train.recordings) digest.text(recording.sha256);
  if (parts.arm) digest.text(parts.arm->sha256);
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (parts.estimators[i].label == plan.label) add(digest, *sections[i]);
  if (!plan.start.empty()) digest.numbers(plan.start);
  return digest.hex();
}

}  // namespace torquescope
