#include "engine/data/confined_reader.hpp"

#include <fmt/format.h>

#include "engine/base/confined.hpp"
#include "engine/base/packed_bytes.hpp"
#include "engine/data/data_problem.hpp"

namespace torquescope {
namespace {

std::string packed(RawTable const& table) {
  PackedWriter out;
  out.text(table.path).text(table.sha256).texts(table.names);
  for (auto const& column : table.columns) out.numbers(column);
  out.whole(static_cast<std::int64_t>(table.unusable.size()));
  for (auto const& column : table.unusable) out.text(column.name).text(column.reason).whole(column.line);
  out.texts(table.units).texts(table.remarks).texts(table.clocks);
  for (std::size_t length : table.lengths) out.whole(static_cast<std::int64_t>(length));
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
  table.units = in.texts();
  table.remarks = in.texts();
  table.clocks = in.texts();
  for (std::size_t c = 0; c < table.clocks.size(); ++c) table.lengths.push_back(static_cast<std::size_t>(in.whole()));
  return table;
}

}  // namespace

RawTable read_confined(std::filesystem::path const& path, RawTable (*read)(std::filesystem::path const&),
                       std::string const& library) {
  return unpacked(run_confined([&] { return packed(read(path)); }, limits_for_file(path, 5),
                               [&](std::string const& how) {
                                 return bad_data(
                                     fmt::format("{} is damaged: {} {} while reading it", path.string(), library, how),
                                     path.string(), 0, "copy it again, or export the recording as CSV");
                               }));
}

}  // namespace torquescope
