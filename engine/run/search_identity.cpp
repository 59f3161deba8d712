#include "engine/run/search_identity.hpp"

#include <set>

#include "engine/base/digest.hpp"

namespace torquescope {
namespace {

void add(Digest& digest, Section const& section, std::set<std::string> const& left_out = {}) {
  digest.text(section.name);
  for (auto const& setting : section.settings) {
    if (left_out.contains(setting.key)) continue;
    digest.text(setting.key).text(to_text(setting.value));
  }
}

}  // namespace

std::string search_sha256(Experiment::Parts const& parts, EstimatorPlan const& plan) {
  Digest digest;
  for (auto const& section : parts.job.sections) {
    if (section.name == "estimator" || section.name == "output" || section.name == "diagnose") continue;
    if (section.name == "experiment")
      add(digest, section, {"name", "study", "runs"});
    else if (section.name == "recording")
      add(digest, section, {"train", "validate"});
    else
      add(digest, section);
  }
  // of the recordings what they hold, wherever they stand
  for (auto const& recording : parts.train.recordings) digest.text(recording.sha256);
  if (parts.arm) digest.text(parts.arm->sha256);
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (parts.estimators[i].label == plan.label) add(digest, *sections[i]);
  return digest.hex();
}

}  // namespace torquescope
