#include "engine/run/diagnosis_result.hpp"

#include <chrono>

#include "engine/run/diagnosis_writer.hpp"
#include "engine/run/experiment_parts.hpp"
#include "engine/run/provenance_writer.hpp"
#include "engine/run/study_writer.hpp"

namespace torquescope {

Diagnosis diagnose_into_file(Experiment const& experiment, DiagnoseRequest const& request,
                             std::function<Diagnosis()> const& find) {
  using Clock = std::chrono::steady_clock;
  auto const start = Clock::now();
  std::string const started = utc_now();
  auto const& parts = experiment.parts();
  ResultWriter writer(request.output, {.gzip = parts.output.compression == "gzip"});
  write_study(writer, experiment);
  Diagnosis diagnosis = find();
  write_diagnosis(writer, diagnosis);
  for (auto const& [key, value] : DiagnoseOptions::table().values(parts.diagnose))
    writer.attribute("/diagnosis/options", key, value);
  write_program(writer);
  std::string const content_sha256 = writer.finish();
  double const seconds = std::chrono::duration<double>(Clock::now() - start).count();
  write_circumstances(request.output, {request.threads, started, seconds, content_sha256});
  return diagnosis;
}

}  // namespace torquescope
