// Datasets: what they may be, their rows, and texts as HDF5 stores them.

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <limits>

#include "engine/base/contract.hpp"
#include "engine/store/h5.hpp"

namespace torquescope::h5 {
namespace {

std::vector<hsize_t> extents(Shape const& shape) { return {shape.begin(), shape.end()}; }

Handle file_type(Element element, std::size_t text_size) {
  if (element == Element::text) return text_type(text_size);
  return Handle(checked(H5Tcopy(element == Element::number ? H5T_IEEE_F64LE : H5T_STD_I64LE), "copy a type"));
}

Handle memory_type(DatasetInfo const& info) {
  if (info.element == Element::text) return text_type(info.text_size);
  return Handle(
      checked(H5Tcopy(info.element == Element::number ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64), "copy a type"));
}

bool is_empty(Shape const& shape) { return std::find(shape.begin(), shape.end(), 0U) != shape.end(); }

Handle creation_list(DatasetPlan const& plan) {
  Handle list = property_list(H5P_DATASET_CREATE);
  checked(H5Pset_obj_track_times(list.id(), 0), "switch times off");
  if (plan.element == Element::number) {
    double const absent = std::numeric_limits<double>::quiet_NaN();
    checked(H5Pset_fill_value(list.id(), H5T_NATIVE_DOUBLE, &absent), "set the fill value");
  }
  if (plan.shape.empty() || is_empty(plan.shape)) {
    checked(H5Pset_layout(list.id(), H5D_COMPACT), "keep a value in its header");
    return list;
  }
  auto const chunk = extents(plan.chunk);
  checked(H5Pset_chunk(list.id(), static_cast<int>(chunk.size()), chunk.data()), "set the chunk");
  if (plan.gzip) checked(H5Pset_deflate(list.id(), 1), "switch compression on");
  // the checksum comes last: it covers the bytes as they lie on the disk
  checked(H5Pset_fletcher32(list.id()), "switch checksums on");
  return list;
}

Element element_of(Handle const& dataset, std::size_t& size) {
  Handle const type(checked(H5Dget_type(dataset.id()), "read a type"));
  H5T_class_t const kind = H5Tget_class(type.id());
  size = H5Tget_size(type.id());
  if (kind == H5T_FLOAT && size == sizeof(double)) return Element::number;
  if (kind == H5T_INTEGER && size == sizeof(std::int64_t)) return Element::whole_number;
  if (kind == H5T_STRING && H5Tis_variable_str(type.id()) == 0 && size > 0) return Element::text;
  throw Failure("its type is none that results have (double, int64, text of fixed length)");
}

Shape chunk_of(Handle const& dataset, std::size_t rank) {
  Handle const list(checked(H5Dget_create_plist(dataset.id()), "read the storage properties"));
  H5D_layout_t const layout = H5Pget_layout(list.id());
  bool const elsewhere = layout == H5D_VIRTUAL || H5Pget_external_count(list.id()) != 0;
  if (elsewhere || layout < 0) throw Failure("its values lie in another file; results are complete in themselves");
  int const n_filters = H5Pget_nfilters(list.id());
  for (int i = 0; i < n_filters; ++i) {
    unsigned flags = 0;
    std::size_t n_values = 0;
    H5Z_filter_t const filter =
        H5Pget_filter2(list.id(), static_cast<unsigned>(i), &flags, &n_values, nullptr, 0, nullptr, nullptr);
    if (filter != H5Z_FILTER_FLETCHER32 && filter != H5Z_FILTER_DEFLATE)
      throw Failure("its filter is none that results have (fletcher32, gzip)");
  }
  if (layout != H5D_CHUNKED) return {};
  std::vector<hsize_t> chunk(rank);
  checked(H5Pget_chunk(list.id(), static_cast<int>(rank), chunk.data()), "read the chunk");
  return {chunk.begin(), chunk.end()};
}

struct Selection {
  Handle memory, file;
};

Selection select_rows(Handle const& dataset, DatasetInfo const& info, std::size_t first, std::size_t count) {
  TORQUESCOPE_EXPECT(first + count <= info.rows());
  Selection selection{Handle(checked(H5Screate(H5S_SCALAR), "make a selection")),
                      Handle(checked(H5Dget_space(dataset.id()), "read the shape"))};
  if (info.shape.empty()) return selection;

  auto start = std::vector<hsize_t>(info.shape.size(), 0);
  auto extent = extents(info.shape);
  start[0] = first;
  extent[0] = count;
  checked(H5Sselect_hyperslab(selection.file.id(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr),
          "select rows");
  selection.memory =
      Handle(checked(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), "make a selection"));
  return selection;
}

}  // namespace

PaddedTexts::PaddedTexts(std::span<std::string const> texts) {
  for (auto const& text : texts) size_of_one = std::max(size_of_one, text.size());
  bytes.assign(texts.size() * size_of_one, '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(&bytes[i * size_of_one], size_of_one);
}

std::vector<std::string> PaddedTexts::texts() const {
  std::vector<std::string> texts;
  for (std::size_t begin = 0; begin < bytes.size(); begin += size_of_one) {
    std::string text = bytes.substr(begin, size_of_one);
    text.erase(text.find_last_not_of('\0') + 1);
    texts.push_back(std::move(text));
  }
  return texts;
}

Handle text_type(std::size_t size) {
  Handle type(checked(H5Tcopy(H5T_C_S1), "make a text type"));
  checked(H5Tset_size(type.id(), std::max<std::size_t>(size, 1)), "set a text's size");
  checked(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), "set a text's padding");
  checked(H5Tset_cset(type.id(), H5T_CSET_UTF8), "set a text's letters");
  return type;
}

std::size_t DatasetInfo::values_per_row() const {
  std::size_t product = 1;
  for (std::size_t i = 1; i < shape.size(); ++i) product *= shape[i];
  return product;
}

Handle create_dataset(Handle const& group, std::string const& name, DatasetPlan const& plan) {
  Handle const type = file_type(plan.element, plan.text_size);
  auto const shape = extents(plan.shape);
  Handle const space(checked(
      shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
      "make a shape"));
  Handle const creation = creation_list(plan);
  return Handle(
      checked(H5Dcreate2(group.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
              "create a dataset"));
}

DatasetInfo describe(Handle const& dataset) {
  if (H5Iget_type(dataset.id()) != H5I_DATASET) throw Failure("it is not a dataset");
  DatasetInfo info;
  std::size_t bytes = 0;
  info.element = element_of(dataset, bytes);
  if (info.element == Element::text) info.text_size = bytes;

  Handle const space(checked(H5Dget_space(dataset.id()), "read the shape"));
  std::array<hsize_t, H5S_MAX_RANK> shape{};
  if (H5Sget_simple_extent_type(space.id()) == H5S_NULL) throw Failure("it has no shape");
  std::int64_t const rank = checked(H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr), "read the shape");
  info.shape.assign(shape.begin(), shape.begin() + rank);
  double claimed_bytes = static_cast<double>(bytes);
  for (std::size_t extent : info.shape) claimed_bytes *= static_cast<double>(std::max<std::size_t>(extent, 1));
  check_claimed_size(dataset, claimed_bytes);
  info.chunk = chunk_of(dataset, info.shape.size());
  return info;
}

void write_chunk(Handle const& dataset, Shape const& first, std::span<std::byte const> bytes) {
  constexpr std::uint32_t no_filter_left_out = 0;
  auto const start = extents(first);
  checked(H5Dwrite_chunk(dataset.id(), H5P_DEFAULT, no_filter_left_out, start.data(), bytes.size(), bytes.data()),
          "write values");
}

void write_rows(Handle const& dataset, DatasetInfo const& info, std::size_t first, std::size_t count,
                void const* values) {
  if (is_empty(info.shape) || count == 0) return;
  Selection const rows = select_rows(dataset, info, first, count);
  Handle const type = memory_type(info);
  checked(H5Dwrite(dataset.id(), type.id(), rows.memory.id(), rows.file.id(), H5P_DEFAULT, values), "write values");
}

void read_rows(Handle const& dataset, DatasetInfo const& info, std::size_t first, std::size_t count, void* values,
               std::size_t spare_bytes) {
  if (is_empty(info.shape) || count == 0) return;
  Handle const type = memory_type(info);
  if (read_plain_chunks(dataset, type, info, first, count, values, spare_bytes)) return;
  Selection const rows = select_rows(dataset, info, first, count);
  checked(H5Dread(dataset.id(), type.id(), rows.memory.id(), rows.file.id(), H5P_DEFAULT, values), "read values");
}

std::vector<std::string> read_texts(Handle const& dataset, DatasetInfo const& info, std::size_t first,
                                    std::size_t count) {
  PaddedTexts padded(is_empty(info.shape) ? 0 : count * info.values_per_row(), info.text_size);
  read_rows(dataset, info, first, count, padded.bytes.data());
  return padded.texts();
}

}  // namespace torquescope::h5
