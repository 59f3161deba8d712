#pragma once
// A file that gets its name only when it is whole: written beside its final name, then fsync, rename, fsync of the
// folder.
//
// Speed      data written at the end collects in blocks of 512 KiB, which another thread (disk_writer.hpp) writes past
//            the page cache: 2.5 GB cost 0.2 s of CPU instead of 1.4 to 6. The first block waits until publish(), since
//            HDF5 comes back to it. Memory: seven blocks
// Lock       a temporary file is locked (flock) as long as its writer lives: one that is not may be removed
// Signals    an interrupted call is made again
// Errors     write_at() and resize() remember the first failure and drop what follows; check() and publish() report it
//            (exit code 74). HDF5 must not see a failing disk: closing a file after a failed write ends the process
// Threads    one at a time; its own thread sees nothing but whole blocks

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/store/disk_writer.hpp"
#include "engine/store/file_place.hpp"

namespace torquescope {

// fsync of the folder that holds a name: before it, a power cut may take the name back. Returns errno of a failure
int sync_folder_of(std::filesystem::path const& name);

class TempFile {
 public:
  // creates FINAL.tmp.<pid> (with .1, .2, ... behind it when a killed process left that name); never follows a link
  // expected_bytes: how large it will be, as far as that is known; said where there is no room
  explicit TempFile(FilePlace place, std::uintmax_t expected_bytes = 0);
  ~TempFile();  // removes the file unless it was published
  TempFile(TempFile const&) = delete;
  TempFile& operator=(TempFile const&) = delete;

  std::filesystem::path const& final_name() const { return place_.path; }
  std::filesystem::path temporary_name() const { return place_.path.string() + ending_; }
  std::uintmax_t expected_bytes() const { return expected_bytes_; }
  std::uint64_t size() const { return size_; }  // as it would be had every write succeeded

  void write_at(std::uint64_t offset, void const* data, std::size_t size) noexcept;
  // zeros behind the end; false when the disk failed
  bool read_at(std::uint64_t offset, void* data, std::size_t size) noexcept;
  void resize(std::uint64_t size) noexcept;

  bool failed() const { return error_number() != 0; }
  void check() const;  // throws Error (exit code 74) when anything was lost
  void publish();      // under its final name, safe against power loss; replaces what was there

 private:
  int error_number() const { return error_number_ != 0 ? error_number_ : writer_.error(); }
  std::uint64_t tail_end() const { return tail_.offset + tail_.size; }
  std::size_t tail_room() const;
  void start_tail();
  void hand_over_tail();
  void write_behind(std::uint64_t offset, std::byte const* bytes, std::size_t size);
  void write_out(FilePiece const& piece);
  void write_tail(std::uint64_t offset, std::byte const* bytes, std::size_t size);
  int write_piece(std::uint64_t offset, std::byte const* bytes, std::size_t size);
  bool write_past_cache(bool wanted);
  std::string temporary() const { return place_.name + ending_; }  // as place_.name: in place_.folder
  int sync_folder() const;

  FilePlace place_;
  std::string ending_;  // of the temporary name
  std::uintmax_t expected_bytes_;
  std::uint64_t size_ = 0;
  int descriptor_ = -1;
  int error_number_ = 0;     // errno of the first failure in the caller's thread
  bool past_cache_ = false;  // how the descriptor writes now
  bool may_bypass_ = true;   // until the file system refuses
  FilePiece head_;           // the first block of a longer file: still to be written
  FilePiece tail_;           // the end of the file, from a multiple of the block size on: still to be written
  DiskWriter writer_;        // last: its thread uses what stands above
};

}  // namespace torquescope
