#include "engine/experiment/diagnosis_input.hpp"

#include <map>
#include <string>
#include <variant>

#include "engine/experiment/job_sections.hpp"

namespace torquescope {

namespace {

// Every recording that the parameters are not fitted to: further ones of training, then those of validation
std::vector<Recording> other_recordings(Experiment::Parts const& parts) {
  std::vector<Recording> others(parts.train.recordings.begin() + 1, parts.train.recordings.end());
  if (parts.validate) others.insert(others.end(), parts.validate->recordings.begin(), parts.validate->recordings.end());
  return others;
}

// of the position, as the file calls it: it names the joint. A simulated recording has none, and one that is called
// "position" names no joint
std::string position_column(Job const& job) {
  Section const recording = section_or_empty(job, "recording");
  Setting const* columns = recording.find("columns");
  if (columns == nullptr) return {};
  auto const* names = std::get_if<std::map<std::string, std::string>>(&columns->value);
  auto const position = names ? names->find("position") : std::map<std::string, std::string>::const_iterator{};
  bool const is_a_name = names && position != names->end() && position->second != "position";
  return is_a_name ? position->second : std::string();
}

// what a job asks of one joint and of an arm alike
template <class Input>
void ask(Experiment::Parts const& parts, int threads, Input& input) {
  input.max_effects = static_cast<std::size_t>(parts.diagnose.max_effects);
  input.numbers = decision_numbers(parts.diagnose, parts.levels);
  input.seed = static_cast<std::uint64_t>(parts.experiment.seed);
  input.threads = threads;
}

}  // namespace

JobInput::JobInput(Experiment::Parts const& parts, int threads)
    : filter_(section_or_empty(parts.job, "filter")),
      others_(other_recordings(parts)),
      input_{parts.train.recordings.front(), others_, *parts.regressor, parts.filter, filter_} {
  ask(parts, threads, input_);
  input_.candidates = parts.effects;
  std::vector<Problem> already_told;  // where the job was read
  input_.loop = read_options<LoopOptions>(parts.job, already_told);
  input_.joint_name = position_column(parts.job);
  input_.further_training = parts.train.recordings.size() - 1;
}

ArmDiagnosisInput arm_input(Experiment::Parts const& parts, Section const& filter, int threads) {
  auto const& arm = *parts.arm;
  ArmDiagnosisInput input{arm.model, arm.train, arm.validate, arm.effects, parts.filter, filter};
  ask(parts, threads, input);
  return input;
}

}  // namespace torquescope
