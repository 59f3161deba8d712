#include "engine/run/diagnosis_input.hpp"

#include <map>
#include <string>
#include <variant>

#include "engine/run/job_sections.hpp"

namespace torquescope {

namespace {

// Every recording that the parameters are not fitted to: further ones of training, then those of validation
std::vector<Recording> other_recordings(Experiment::Parts const& parts) {
  std::vector<Recording> others(parts.train.recordings.begin() + 1, parts.train.recordings.end());
  if (parts.validate) others.insert(others.end(), parts.validate->recordings.begin(), parts.validate->recordings.end());
  return others;
}

// of the position, as the file calls it; a simulated recording has none
std::string position_column(Job const& job) {
  Section const recording = section_or_empty(job, "recording");
  Setting const* columns = recording.find("columns");
  if (columns == nullptr) return {};
  auto const* names = std::get_if<std::map<std::string, std::string>>(&columns->value);
  auto const position = names ? names->find("position") : std::map<std::string, std::string>::const_iterator{};
  return names && position != names->end() ? position->second : std::string();
}

}  // namespace

JobInput::JobInput(Experiment::Parts const& parts, int threads, TwinExchange* exchange)
    : filter_(section_or_empty(parts.job, "filter")),
      others_(other_recordings(parts)),
      input_{parts.train.recordings.front(), others_, *parts.regressor, parts.filter, filter_} {
  input_.selection.candidates = parts.effects;
  input_.selection.q = parts.diagnose.q;
  input_.selection.max_effects = static_cast<std::size_t>(parts.diagnose.max_effects);
  input_.selection.shape_optimiser = parts.diagnose.shape_optimiser;
  input_.twins = static_cast<std::size_t>(parts.diagnose.twins);
  input_.seed = static_cast<std::uint64_t>(parts.experiment.seed);
  input_.threads = threads;
  input_.joint_name = position_column(parts.job);
  input_.further_training = parts.train.recordings.size() - 1;
  input_.exchange = exchange;
  input_.reversals = reversals_of(parts.diagnose.reversals);
  input_.ablation = {null_of(parts.diagnose.null), parts.diagnose.indirect_inference, parts.diagnose.twin_noise,
                     parts.diagnose.whitening};
}

}  // namespace torquescope
