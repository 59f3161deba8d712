#pragma once
// A file that gets its name only when it is whole: written beside its final name, then fsync, rename, fsync of the
// folder.
//
// Of all the ways to write a file that were killed, cut off from power or left without space, only this one (and an
// append-only journal) lost nothing.
//
// Errors     write_at() and resize() never fail loudly: the first failure is remembered, what follows is dropped, and
//            check() or publish() tell (exit code 74). HDF5 writes through them and must not see a failing disk:
//            closing a file after a failed write ends the process inside HDF5's exit handler.
// Threads    one at a time

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace torquescope {

class TempFile {
 public:
  // creates FINAL.tmp.<pid> (with .1, .2, ... behind it when a killed process left that name); never follows a link
  explicit TempFile(std::filesystem::path final_name);
  ~TempFile();  // removes the file unless it was published
  TempFile(TempFile const&) = delete;
  TempFile& operator=(TempFile const&) = delete;

  std::filesystem::path const& final_name() const { return final_name_; }
  std::filesystem::path const& temporary_name() const { return temporary_name_; }
  std::uint64_t size() const { return size_; }  // as it would be had every write succeeded

  void write_at(std::uint64_t offset, void const* data, std::size_t size) noexcept;
  // zeros behind the end; false when the disk failed
  bool read_at(std::uint64_t offset, void* data, std::size_t size) const noexcept;
  void resize(std::uint64_t size) noexcept;

  bool failed() const { return error_number_ != 0; }
  void check() const;  // throws Error (exit code 74) when anything was lost
  void publish();      // under its final name, safe against power loss; replaces what was there

 private:
  std::filesystem::path final_name_;
  std::filesystem::path temporary_name_;
  std::uint64_t size_ = 0;
  int descriptor_ = -1;
  int error_number_ = 0;  // errno of the first failure
};

}  // namespace torquescope
