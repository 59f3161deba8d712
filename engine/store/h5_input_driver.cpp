#include "engine/store/h5_input_driver.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

namespace torquescope::h5 {
namespace {

struct DriverInfo {
  int descriptor;
  haddr_t size;
};

// HDF5 hands out and takes back pointers to the first member
struct InputFile {
  H5FD_t base{};
  DriverInfo file{};
  haddr_t allocated = 0;  // end of what the file says that it has
};

InputFile const& input_of(H5FD_t const* base) { return *reinterpret_cast<InputFile const*>(base); }

H5FD_t* open_file(char const*, unsigned, hid_t access_list, haddr_t) {
  auto const* info = static_cast<DriverInfo const*>(H5Pget_driver_info(access_list));
  if (!info) return nullptr;
  auto input = std::make_unique<InputFile>();
  input->file = *info;
  return &input.release()->base;
}

herr_t close_file(H5FD_t* base) {
  delete reinterpret_cast<InputFile*>(base);
  return 0;
}

herr_t query_features(H5FD_t const*, unsigned long* features) {
  if (features)
    *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
                H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t allocated_end(H5FD_t const* base, H5FD_mem_t) { return input_of(base).allocated; }

herr_t set_allocated_end(H5FD_t* base, H5FD_mem_t, haddr_t end) {
  reinterpret_cast<InputFile*>(base)->allocated = end;
  return 0;
}

haddr_t end_of_file(H5FD_t const* base, H5FD_mem_t) { return input_of(base).file.size; }

herr_t read_bytes(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t offset, std::size_t size, void* data) {
  auto const& file = input_of(base).file;
  std::size_t const there = offset < file.size ? std::min<std::size_t>(size, file.size - offset) : 0;
  std::memset(static_cast<char*>(data) + there, 0, size - there);
  if (read_at(file.descriptor, offset, data, there)) return 0;
  int const error_number = errno != 0 ? errno : EIO;  // shorter than it was
  H5Epush2(H5E_DEFAULT, __FILE__, __func__, __LINE__, H5E_ERR_CLS, H5E_IO, H5E_READERROR,
           "file read failed: errno = %d, error message = '%s'", error_number, std::strerror(error_number));
  return -1;
}

herr_t write_bytes(H5FD_t*, H5FD_mem_t, hid_t, haddr_t, std::size_t, void const*) { return -1; }

H5FD_class_t make_driver_class() {
  H5FD_class_t driver{};
  driver.name = "torquescope_input";
  driver.maxaddr = (static_cast<haddr_t>(1) << 62) - 1;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(DriverInfo);
  driver.open = open_file;
  driver.close = close_file;
  driver.query = query_features;
  driver.get_eoa = allocated_end;
  driver.set_eoa = set_allocated_end;
  driver.get_eof = end_of_file;
  driver.read = read_bytes;
  driver.write = write_bytes;
  H5FD_mem_t const one_list_for_all[] = H5FD_FLMAP_DICHOTOMY;
  for (int i = 0; i < H5FD_MEM_NTYPES; ++i) driver.fl_map[i] = one_list_for_all[i];
  return driver;
}

}  // namespace

bool use_input_driver(std::int64_t access_list, ReadFile const& file) {
  static H5FD_class_t const driver_class = make_driver_class();
  static hid_t const driver = H5FDregister(&driver_class);
  DriverInfo const info{file.descriptor(), file.size()};
  return driver >= 0 && H5Pset_driver(access_list, driver, &info) >= 0;
}

}  // namespace torquescope::h5
