#pragma once
// What drivers of HDF5 have in common: a file that its access list brings, one end of what is handed out, one list of
// free space.
//
// Info       what an access list keeps of a file: bytes that may be copied
// File       a struct of an Info and `haddr_t allocated`, which does what HDF5 asks: end(), read(offset, data, size),
//            write(kind, offset, data, size); both false after a failure
// Source     H5FDpublic.h of HDF5 1.10 (H5FD_class_t); H5FDsec2.c for what a driver of files has to do

#include <hdf5.h>

#include <memory>
#include <type_traits>

namespace torquescope::h5 {

template <class File, class Info>
class Driver {
 public:
  static H5FD_class_t as_class(char const* name) {
    H5FD_class_t driver{};
    driver.name = name;
    driver.maxaddr = (static_cast<haddr_t>(1) << 62) - 1;
    driver.fc_degree = H5F_CLOSE_STRONG;
    driver.fapl_size = sizeof(Info);
    driver.open = open;
    driver.close = close;
    driver.query = query_features;
    driver.get_eoa = [](H5FD_t const* base, H5FD_mem_t) { return of(base).allocated; };
    driver.set_eoa = set_allocated;
    driver.get_eof = [](H5FD_t const* base, H5FD_mem_t) -> haddr_t { return of(base).end(); };
    driver.read = read;
    driver.write = write;
    H5FD_mem_t const one_list_for_all[] = H5FD_FLMAP_DICHOTOMY;
    for (int i = 0; i < H5FD_MEM_NTYPES; ++i) driver.fl_map[i] = one_list_for_all[i];
    return driver;
  }

  static File& of(H5FD_t* base) { return reinterpret_cast<Opened*>(base)->file; }
  static File const& of(H5FD_t const* base) { return reinterpret_cast<Opened const*>(base)->file; }

 private:
  // HDF5 hands out and takes back pointers to the first member
  struct Opened {
    explicit Opened(Info const& info) : file{info} {}
    H5FD_t base{};
    File file;
  };
  static_assert(std::is_standard_layout_v<Opened>);

  static H5FD_t* open(char const*, unsigned, hid_t access_list, haddr_t) {
    auto const* info = static_cast<Info const*>(H5Pget_driver_info(access_list));
    return info ? &std::make_unique<Opened>(*info).release()->base : nullptr;
  }

  static herr_t close(H5FD_t* base) {
    std::unique_ptr<Opened> const opened(reinterpret_cast<Opened*>(base));
    return 0;
  }

  static herr_t query_features(H5FD_t const*, unsigned long* features) {
    if (features)
      *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
                  H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
  }

  static herr_t set_allocated(H5FD_t* base, H5FD_mem_t, haddr_t end) {
    of(base).allocated = end;
    return 0;
  }

  static herr_t read(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t offset, std::size_t size, void* data) {
    return of(base).read(offset, data, size) ? 0 : -1;
  }

  static herr_t write(H5FD_t* base, H5FD_mem_t kind, hid_t, haddr_t offset, std::size_t size, void const* data) {
    return of(base).write(kind, offset, data, size) ? 0 : -1;
  }
};

}  // namespace torquescope::h5
