#include "engine/run/search_identity.hpp"

#include <set>
#include <variant>

#include "engine/base/digest.hpp"

namespace torquescope {
namespace {

struct AddValue {
  Digest& digest;
  void operator()(bool value) const { digest.text(value ? "true" : "false"); }
  void operator()(std::int64_t value) const { digest.bytes(&value, sizeof(value)); }
  void operator()(double value) const { digest.bytes(&value, sizeof(value)); }
  void operator()(std::string const& value) const { digest.text(value); }
  void operator()(std::vector<double> const& values) const { digest.numbers(values); }
  void operator()(std::vector<std::string> const& values) const {
    for (auto const& value : values) digest.text(value);
  }
  void operator()(std::map<std::string, std::string> const& values) const {
    for (auto const& [key, value] : values) digest.text(key).text(value);
  }
};

void add(Digest& digest, Section const& section, std::set<std::string> const& left_out = {}) {
  digest.text(section.name);
  for (auto const& setting : section.settings) {
    if (left_out.contains(setting.key)) continue;
    digest.text(setting.key);
    std::visit(AddValue{digest}, setting.value);
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
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (parts.estimators[i].label == plan.label) add(digest, *sections[i]);
  return digest.hex();
}

}  // namespace torquescope
