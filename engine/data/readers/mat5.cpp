// MATLAB files of level 5 (save -v6, -v7; Octave, scipy.io.savemat): real vectors and matrices.
//
// Names      the variable's; a matrix gives "name[0]", "name[1]", ... (rows are samples)
// Checked    class, rank and size before anything is allocated; the bytes parsed are those of the sha256
// Confined   in a process of its own: of a hundred damaged files two crash matio or keep it busy for ever
// Errors     Error 65 when the file is damaged
// Source     matio; MATLAB "MAT-File Format", level 5. Version 7.3 is HDF5: readers/hdf5.cpp

#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <memory>

#include "engine/base/digest.hpp"
#include "engine/base/error.hpp"
#include "engine/base/memory_file.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/data/table_builder.hpp"

namespace torquescope {
namespace {

constexpr std::size_t most_variables = 20000;

using MatFile = std::unique_ptr<mat_t, int (*)(mat_t*)>;
using MatVariable = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;

bool accepts(std::filesystem::path const&, std::string const& first_bytes) {
  return first_bytes.starts_with("MATLAB 5.0 MAT-file");
}

// a vector of numbers of any stored type as doubles
template <class Number>
std::vector<double> as_doubles(void const* data, std::size_t count) {
  auto const* numbers = static_cast<Number const*>(data);
  return {numbers, numbers + count};
}

std::vector<double> values_of(matvar_t const& variable, std::size_t count) {
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return as_doubles<double>(variable.data, count);
    case MAT_C_SINGLE:
      return as_doubles<float>(variable.data, count);
    case MAT_C_INT8:
      return as_doubles<std::int8_t>(variable.data, count);
    case MAT_C_UINT8:
      return as_doubles<std::uint8_t>(variable.data, count);
    case MAT_C_INT16:
      return as_doubles<std::int16_t>(variable.data, count);
    case MAT_C_UINT16:
      return as_doubles<std::uint16_t>(variable.data, count);
    case MAT_C_INT32:
      return as_doubles<std::int32_t>(variable.data, count);
    case MAT_C_UINT32:
      return as_doubles<std::uint32_t>(variable.data, count);
    case MAT_C_INT64:
      return as_doubles<std::int64_t>(variable.data, count);
    case MAT_C_UINT64:
      return as_doubles<std::uint64_t>(variable.data, count);
    default:
      return {};
  }
}

// why a variable cannot serve, or ""
std::string objection(matvar_t const& variable) {
  switch (variable.class_type) {
    case MAT_C_CHAR:
      return "is text";
    case MAT_C_STRUCT:
      return "is a struct; save its fields as variables: save(\"file.mat\", \"-struct\", \"name\")";
    case MAT_C_DOUBLE:
    case MAT_C_SINGLE:
    case MAT_C_INT8:
    case MAT_C_UINT8:
    case MAT_C_INT16:
    case MAT_C_UINT16:
    case MAT_C_INT32:
    case MAT_C_UINT32:
    case MAT_C_INT64:
    case MAT_C_UINT64:
      break;
    default:
      return "is not a plain matrix of numbers";
  }
  if (variable.isComplex) return "is complex";
  if (variable.rank != 2 || variable.dims == nullptr)
    return fmt::format("has {} dimensions (a table of signals has 2)", variable.rank);
  if (variable.dims[0] == 0 || variable.dims[1] == 0) return "is empty";
  return {};
}

void add_variable(mat_t* file, matvar_t& variable, TableBuilder& table) {
  std::string const name = variable.name != nullptr ? variable.name : "";
  auto const reason = objection(variable);
  if (!reason.empty()) {
    table.cannot_use(name, reason);
    return;
  }
  std::size_t const rows = variable.dims[0], columns = variable.dims[1];
  table.reserve(rows, columns, name);
  std::size_t const count = rows * columns;
  bool const read = Mat_VarReadDataAll(file, &variable) == 0 && variable.data != nullptr;
  // the size of the data is asked again: a damaged file may hold fewer numbers than it claims
  bool const complete =
      read && variable.data_size > 0 && variable.nbytes / static_cast<std::size_t>(variable.data_size) >= count;
  if (!complete) {
    table.cannot_use(name, "is damaged");
    return;
  }
  table.add_matrix(name, values_of(variable, count), rows, columns, true);
}

RawTable read(std::filesystem::path const& path) {
  auto const bytes = read_whole_file(path);
  constexpr std::uint64_t best_compression = 1032;  // of deflate; and a number takes at least a byte before it
  TableBuilder table(path.string(), sha256_hex(bytes), best_compression * bytes.size());
  MemoryFile const copy(bytes);  // matio reads only paths, and the file must not change after it was hashed
  MatFile const file(Mat_Open(copy.path().c_str(), MAT_ACC_RDONLY), Mat_Close);
  validate(file != nullptr, [&] {
    return bad_data(fmt::format("{} is a damaged MAT file, or was cut short", path.string()), path.string(), 0,
                    "copy it again, or save it again: save -v7 file.mat t q tau");
  });
  for (std::size_t k = 0; k < most_variables; ++k) {
    MatVariable const variable(Mat_VarReadNextInfo(file.get()), Mat_VarFree);
    if (variable == nullptr) break;
    add_variable(file.get(), *variable, table);
  }
  return std::move(table).finish();
}

}  // namespace

ReaderChoice mat5_reader() {
  return {"mat5", "MATLAB level 5 (-v6, -v7), Octave, scipy: real vectors and matrices", accepts, read, "matio"};
}

}  // namespace torquescope
