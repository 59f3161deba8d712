#include "engine/store/h5_output_driver.hpp"

#include "engine/store/h5_driver.hpp"

namespace torquescope::h5 {
namespace {

struct OutputInfo {
  TempFile* file;
  ByteRanges* values;
};

struct OutputFile {
  OutputInfo info;
  haddr_t allocated = 0;  // end of what HDF5 has handed out

  haddr_t end() const { return info.file->size(); }

  bool read(haddr_t offset, void* data, std::size_t size) { return info.file->read_at(offset, data, size); }

  bool write(H5FD_mem_t kind, haddr_t offset, void const* data, std::size_t size) {
    auto& values = *info.values;
    kind == H5FD_MEM_DRAW ? values.add(offset, offset + size) : values.remove(offset, offset + size);
    info.file->write_at(offset, data, size);
    return true;
  }

  void truncate() {
    if (info.file->size() != allocated) info.file->resize(allocated);
  }
};

H5FD_class_t make_output_driver() {
  using OutputDriver = Driver<OutputFile, OutputInfo>;
  H5FD_class_t driver = OutputDriver::as_class("torquescope_output");
  driver.truncate = [](H5FD_t* base, hid_t, hbool_t) -> herr_t {
    OutputDriver::of(base).truncate();
    return 0;
  };
  return driver;
}

}  // namespace

bool use_output_driver(std::int64_t access_list, TempFile& file, ByteRanges& values) {
  static H5FD_class_t const driver_class = make_output_driver();
  static hid_t const driver = H5FDregister(&driver_class);
  OutputInfo const info{&file, &values};
  return driver >= 0 && H5Pset_driver(access_list, driver, &info) >= 0;
}

}  // namespace torquescope::h5
