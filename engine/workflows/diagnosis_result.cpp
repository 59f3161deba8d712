#include "engine/workflows/diagnosis_result.hpp"

#include "engine/experiment/experiment_parts.hpp"
#include "engine/experiment/replay_of_parts.hpp"
#include "engine/experiment/runs/provenance_writer.hpp"
#include "engine/store/temp_file.hpp"
#include "engine/workflows/replay_writer.hpp"
#include "engine/workflows/results/diagnosis_writer.hpp"
#include "engine/workflows/results/study_writer.hpp"

namespace torquescope {

Diagnosis diagnose_into_file(Experiment const& experiment, DiagnoseRequest const& request,
                             std::function<Diagnosis()> const& find) {
  Beginning const beginning;
  auto const& parts = experiment.parts();
  // whether there may be a file is asked before hours are spent; while they pass, there is none that a killed process
  // would leave
  { TempFile const asked(request.output); }
  Diagnosis diagnosis = find();
  ResultWriter writer(request.output,
                      {.gzip = parts.output.compression == "gzip", .inputs_sha256 = experiment.inputs_sha256()});
  write_study(writer, experiment);
  write_diagnosis(writer, diagnosis);
  for (auto const& [key, value] : DiagnoseOptions::table().values(parts.diagnose))
    writer.attribute("/diagnosis/options", key, value);
  for (auto const& [key, value] : LevelOptions::table().values(parts.levels))
    writer.attribute("/diagnosis/options/levels", key, value);
  if (auto const replay = replay_of_diagnosis(parts, diagnosis, request.threads.count)) write_replay(writer, *replay);
  finish_result(writer, request.output, request.threads, beginning);
  return diagnosis;
}

}  // namespace torquescope
