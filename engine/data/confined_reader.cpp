#include "engine/data/confined_reader.hpp"

#include <fmt/format.h>

#include <system_error>

#include "engine/base/confined.hpp"
#include "engine/base/packed_bytes.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/file_bytes.hpp"

namespace torquescope {
namespace {

std::string packed(RawTable const& table) {
  PackedWriter out;
  out.text(table.path).text(table.sha256).texts(table.names);
  for (auto const& column : table.columns) out.numbers(column);
  out.whole(static_cast<std::int64_t>(table.unusable.size()));
  for (auto const& column : table.unusable) out.text(column.name).text(column.reason).whole(column.line);
  return std::move(out).take();
}

RawTable unpacked(std::string_view bytes) {
  PackedReader in(bytes);
  RawTable table;
  table.path = in.text();
  table.sha256 = in.text();
  table.names = in.texts();
  for (std::size_t c = 0; c < table.names.size(); ++c) table.columns.push_back(in.numbers<double>());
  for (std::size_t n = in.count(); n > 0; --n) {
    UnusableColumn column{in.text(), in.text(), 0};
    column.line = in.whole();
    table.unusable.push_back(std::move(column));
  }
  return table;
}

// far more than an honest file of this size takes: half a second per MiB
ConfinedLimits limits_for(std::filesystem::path const& path) {
  std::error_code unknown;
  auto const bytes = std::filesystem::file_size(path, unknown);
  constexpr std::uintmax_t bytes_per_second = std::uintmax_t{2} << 20;
  ConfinedLimits limits;
  if (!unknown) limits.processor_seconds += static_cast<int>(std::min(bytes, largest_file_bytes) / bytes_per_second);
  return limits;
}

}  // namespace

RawTable read_confined(std::filesystem::path const& path, RawTable (*read)(std::filesystem::path const&),
                       std::string const& library) {
  return unpacked(run_confined([&] { return packed(read(path)); }, limits_for(path),
                               [&](std::string const& how) {
                                 return bad_data(
                                     fmt::format("{} is damaged: {} {} while reading it", path.string(), library, how),
                                     path.string(), 0, "copy it again, or export the recording as CSV");
                               }));
}

}  // namespace torquescope
