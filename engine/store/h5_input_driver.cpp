#include "engine/store/h5_input_driver.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "engine/store/h5_driver.hpp"

namespace torquescope::h5 {
namespace {

struct InputInfo {
  int descriptor;
  haddr_t size;
};

struct InputFile {
  InputInfo info;
  haddr_t allocated = 0;  // end of what the file says that it has

  haddr_t end() const { return info.size; }

  bool read(haddr_t offset, void* data, std::size_t size) const {
    std::size_t const there = offset < info.size ? std::min<std::size_t>(size, info.size - offset) : 0;
    std::memset(static_cast<char*>(data) + there, 0, size - there);
    if (read_at(info.descriptor, offset, data, there)) return true;
    int const error_number = errno != 0 ? errno : EIO;  // shorter than it was
    H5Epush2(H5E_DEFAULT, __FILE__, __func__, __LINE__, H5E_ERR_CLS, H5E_IO, H5E_READERROR,
             "file read failed: errno = %d, error message = '%s'", error_number, std::strerror(error_number));
    return false;
  }

  bool write(H5FD_mem_t, haddr_t, void const*, std::size_t) const { return false; }
};

}  // namespace

bool use_input_driver(std::int64_t access_list, ReadFile const& file) {
  static H5FD_class_t const driver_class = Driver<InputFile, InputInfo>::as_class("torquescope_input");
  static hid_t const driver = H5FDregister(&driver_class);
  InputInfo const info{file.descriptor(), file.size()};
  return driver >= 0 && H5Pset_driver(access_list, driver, &info) >= 0;
}

}  // namespace torquescope::h5
