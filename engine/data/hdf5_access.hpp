#pragma once
// What every use of HDF5's C library needs: identifiers that close themselves, silence, texts.
//
// Threads    one at a time
// Source     HDF5 1.10 C API

#include <hdf5.h>

#include <string>
#include <vector>

namespace torquescope {

// an identifier of the library, closed by the function that belongs to it
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle const&) = delete;
  Handle& operator=(Handle const&) = delete;
  hid_t id() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// the library prints its error stack unless told not to; our messages say what a user can use
class QuietErrors {
 public:
  QuietErrors() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  QuietErrors(QuietErrors const&) = delete;
  QuietErrors& operator=(QuietErrors const&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

// the texts of a one-dimensional string attribute or dataset, or nothing
std::vector<std::string> text_attribute(hid_t object, char const* name);
std::vector<std::string> text_dataset(hid_t group, std::string const& name);

}  // namespace torquescope
