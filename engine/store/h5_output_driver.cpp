#include "engine/store/h5_output_driver.hpp"

#include <hdf5.h>

#include <memory>

namespace torquescope::h5 {
namespace {

struct DriverInfo {
  TempFile* file;
  ByteRanges* values;
};

// HDF5 hands out and takes back pointers to the first member
struct OutputFile {
  H5FD_t base{};
  TempFile* file = nullptr;
  ByteRanges* values = nullptr;
  haddr_t allocated = 0;  // end of what HDF5 has handed out
};

TempFile& file_of(H5FD_t* base) { return *reinterpret_cast<OutputFile*>(base)->file; }
OutputFile const* output_of(H5FD_t const* base) { return reinterpret_cast<OutputFile const*>(base); }

H5FD_t* open_file(char const*, unsigned, hid_t access_list, haddr_t) {
  auto const* info = static_cast<DriverInfo const*>(H5Pget_driver_info(access_list));
  if (!info) return nullptr;
  auto output = std::make_unique<OutputFile>();
  output->file = info->file;
  output->values = info->values;
  return &output.release()->base;
}

herr_t close_file(H5FD_t* base) {
  delete reinterpret_cast<OutputFile*>(base);
  return 0;
}

herr_t query_features(H5FD_t const*, unsigned long* features) {
  if (features)
    *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
                H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t allocated_end(H5FD_t const* base, H5FD_mem_t) { return output_of(base)->allocated; }

herr_t set_allocated_end(H5FD_t* base, H5FD_mem_t, haddr_t end) {
  reinterpret_cast<OutputFile*>(base)->allocated = end;
  return 0;
}

haddr_t written_end(H5FD_t const* base, H5FD_mem_t) { return output_of(base)->file->size(); }

herr_t read_bytes(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t offset, std::size_t size, void* data) {
  return file_of(base).read_at(offset, data, size) ? 0 : -1;
}

herr_t write_bytes(H5FD_t* base, H5FD_mem_t kind, hid_t, haddr_t offset, std::size_t size, void const* data) {
  auto& values = *reinterpret_cast<OutputFile*>(base)->values;
  kind == H5FD_MEM_DRAW ? values.add(offset, offset + size) : values.remove(offset, offset + size);
  file_of(base).write_at(offset, data, size);
  return 0;
}

herr_t truncate_file(H5FD_t* base, hid_t, hbool_t) {
  OutputFile const* output = output_of(base);
  if (output->file->size() != output->allocated) output->file->resize(output->allocated);
  return 0;
}

H5FD_class_t make_driver_class() {
  H5FD_class_t driver{};
  driver.name = "torquescope_output";
  driver.maxaddr = (static_cast<haddr_t>(1) << 62) - 1;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(DriverInfo);
  driver.open = open_file;
  driver.close = close_file;
  driver.query = query_features;
  driver.get_eoa = allocated_end;
  driver.set_eoa = set_allocated_end;
  driver.get_eof = written_end;
  driver.read = read_bytes;
  driver.write = write_bytes;
  driver.truncate = truncate_file;
  H5FD_mem_t const one_list_for_all[] = H5FD_FLMAP_DICHOTOMY;
  for (int i = 0; i < H5FD_MEM_NTYPES; ++i) driver.fl_map[i] = one_list_for_all[i];
  return driver;
}

}  // namespace

bool use_output_driver(std::int64_t access_list, TempFile& file, ByteRanges& values) {
  static H5FD_class_t const driver_class = make_driver_class();
  static hid_t const driver = H5FDregister(&driver_class);
  DriverInfo const info{&file, &values};
  return driver >= 0 && H5Pset_driver(access_list, driver, &info) >= 0;
}

}  // namespace torquescope::h5
