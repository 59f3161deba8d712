// Arrays of numpy: one in a .npy file, several in an .npz (numpy.savez, numpy.savez_compressed).
//
// Names      the array's; "array" in a .npy file. A matrix (rows are samples) gives "name[0]", "name[1]", ...; a
//            structured array gives its fields
// Checked    sizes against the bytes stored, before anything is allocated; the bytes parsed are those of the sha256
// Errors     Error 65 when the file is damaged, holds no array, or is a zip file of another kind
// Source     zip_archive.hpp, npy_array.hpp

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/digest.hpp"
#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/data/foreign_file.hpp"
#include "engine/data/npy_array.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/data/table_builder.hpp"
#include "engine/data/zip_archive.hpp"

namespace torquescope {
namespace {

constexpr std::string_view suffix = ".npy";

bool accepts(std::filesystem::path const&, std::string const& first_bytes) {
  return is_npy(first_bytes) || is_zip(first_bytes);
}

// why an array cannot serve, or ""
std::string objection(NpyArray const& array) {
  if (array.shape.empty()) return "is one number, not a signal";
  if (array.shape.size() > 2)
    return fmt::format("has {} dimensions (a signal has 1, a table of signals 2)", array.shape.size());
  bool const structured = !array.fields.front().name.empty();
  if (structured && array.shape.size() == 2) return "is a structured matrix; save its fields as arrays";
  for (auto const& field : array.fields)
    if (!field.objection.empty() && (!structured || field.kind == 'O')) return field.objection;
  return array.count() == 0 ? "is empty" : "";
}

std::vector<double> column_of(NpyArray const& array, NpyField const& field) {
  std::vector<double> values(static_cast<std::size_t>(array.count()));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = npy_value(array, field, i);
  return values;
}

void add_array(TableBuilder& table, std::string const& name, NpyArray const& array) {
  if (auto const reason = objection(array); !reason.empty()) return table.cannot_use(name, reason);
  std::uint64_t const rows = array.shape[0], columns = array.shape.size() == 2 ? array.shape[1] : 1;
  bool const structured = !array.fields.front().name.empty();
  table.reserve(rows, columns * array.fields.size(), name);
  if (!structured)
    return table.add_matrix(name, column_of(array, array.fields.front()), static_cast<std::size_t>(rows),
                            static_cast<std::size_t>(columns), array.column_major);
  for (auto const& field : array.fields) {
    if (field.objection.empty())
      table.add(field.name, column_of(array, field));
    else
      table.cannot_use(field.name, field.objection);
  }
}

RawTable read(std::filesystem::path const& path) {
  auto const bytes = read_whole_file(path);
  constexpr std::uint64_t best_compression = 1032;  // of deflate
  TableBuilder table(path.string(), sha256_hex(bytes), best_compression * bytes.size());
  if (is_npy(bytes)) {
    add_array(table, "array", read_npy(bytes, path.string(), path.string()));
    return std::move(table).finish();
  }
  ZipArchive const archive(bytes, path.string());
  bool const any = std::any_of(archive.members().begin(), archive.members().end(),
                               [](auto const& member) { return member.name.ends_with(suffix); });
  if (!any) throw Error(foreign_zip(path, archive));
  std::uint64_t total = 0;
  for (auto const& member : archive.members()) {
    if (!member.name.ends_with(suffix)) continue;
    total += member.bytes;
    validate(total <= largest_file_bytes, [&] {
      return bad_data(fmt::format("{} unpacks to more than {} MiB", path.string(), largest_file_bytes >> 20),
                      path.string(), 0, "cut it into several recordings: recording.train takes a list");
    });
    std::string const unpacked = archive.unpack(member);
    auto const what = fmt::format("\"{}\" in {}", member.name, path.string());
    add_array(table, member.name.substr(0, member.name.size() - suffix.size()),
              read_npy(unpacked, what, path.string()));
  }
  return std::move(table).finish();
}

}  // namespace

ReaderChoice npz_reader() {
  return {"npz", "arrays of numpy (.npz, .npy): vectors, matrices, structured arrays", accepts, read};
}

}  // namespace torquescope
