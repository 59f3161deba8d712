#include "engine/experiment/runs/provenance_writer.hpp"

#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "engine/base/version.hpp"
#include "engine/experiment/experiment.hpp"
#include "engine/experiment/runs/code_identity.hpp"
#include "engine/store/result_files.hpp"
#include "engine/store/segment_folder.hpp"
#include "engine/store/temp_file.hpp"

namespace torquescope {

namespace {

using Json = nlohmann::ordered_json;

// what a batch system says of this process
Json scheduler() {
  Json facts = Json::object();
  for (char const* name : {"SLURM_JOB_ID", "SLURM_ARRAY_JOB_ID", "SLURM_ARRAY_TASK_ID", "SLURM_RESTART_COUNT",
                           "SLURM_PROCID", "OMPI_COMM_WORLD_RANK"})
    if (char const* value = std::getenv(name)) facts[name] = value;
  return facts;
}

// one line per process that left segments
Json attempts(std::vector<SegmentOrigin> const& segments) {
  Json lines = Json::array();
  std::set<std::tuple<std::string, std::int64_t, std::string>> told;
  for (auto const& origin : segments)
    if (told.insert({origin.host, origin.pid, origin.started}).second)
      lines.push_back({{"host", origin.host},
                       {"pid", origin.pid},
                       {"started", origin.started},
                       {"threads", origin.threads},
                       {"shard", std::to_string(origin.shard_index) + "/" + std::to_string(origin.shard_count)},
                       {"job_sha256", origin.job_sha256},
                       {"numerics_sha256", origin.numerics_sha256}});
  return lines;
}

}  // namespace

std::string utc_now() {
  std::time_t const now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

double Beginning::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - at).count();
}

std::string finish_result(ResultWriter& writer, std::filesystem::path const& result, ThreadChoice const& threads,
                          Beginning const& beginning, MadeOf const& made_of) {
  std::string const group = "/provenance";
  writer.attribute(group, "version", std::string(version));
  writer.attribute(group, "compiler", std::string(compiler));
  writer.attribute(group, "build_type", std::string(build_type));
  writer.attribute(group, "numerics_sha256", numerics_sha256());
  std::string content_sha256 = writer.finish();

  Json document = {{"schema", 1},
                   {"content_sha256", content_sha256},
                   {"started", beginning.started},
                   {"finished", utc_now()},
                   {"seconds", beginning.seconds()},
                   {"host", host_name()},
                   {"threads", threads.count},
                   {"threads_reason", threads.reason},
                   {"vector_target", vector_target()},
                   {"commit", source_commit()},
                   {"scheduler", scheduler()},
                   {"attempts_before", attempts(made_of.segments)}};
  if (!made_of.continued_sha256.empty()) document["continued"] = made_of.continued_sha256;
  std::string const text = document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  TempFile file(circumstances_file_of(result), text.size());
  file.write_at(0, text.data(), text.size());
  file.publish();
  return content_sha256;
}

}  // namespace torquescope
