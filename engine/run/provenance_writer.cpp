#include "engine/run/provenance_writer.hpp"

#include <unistd.h>

#include <cstdint>
#include <ctime>

#include "engine/base/version.hpp"
#include "engine/run/workflows.hpp"

namespace torquescope {

namespace {

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof(name) - 1) == 0 ? name : "unknown";
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

void write_provenance(ResultWriter& writer, ThreadChoice const& threads, std::string const& started, double seconds) {
  std::string const group = "/provenance";
  writer.attribute(group, "started", started);
  writer.attribute(group, "finished", utc_now());
  writer.attribute(group, "seconds", seconds);
  writer.attribute(group, "host", host_name());
  writer.attribute(group, "threads", std::int64_t{threads.count});
  writer.attribute(group, "threads_reason", threads.reason);
  writer.attribute(group, "vector_target", vector_target());
  writer.attribute(group, "version", std::string(version));
  writer.attribute(group, "compiler", std::string(compiler));
  writer.attribute(group, "build_type", std::string(build_type));
}

}  // namespace torquescope
