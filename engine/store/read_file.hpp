#pragma once
// A regular file, opened once to be read: whatever is read of it is of this very file, whatever its name leads to
// meanwhile.
//
// Links      followed under a path; refused in an open folder (file_place.hpp), where nobody but this program has names
// Errors     66 when there is no such file; 65 when it is not a regular one; 74 when the disk cannot open it
// Threads    const: any

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "engine/store/file_place.hpp"

namespace torquescope {

class ReadFile {
 public:
  explicit ReadFile(FilePlace const& place);
  ~ReadFile();
  ReadFile(ReadFile&& other) noexcept;
  ReadFile& operator=(ReadFile&&) = delete;

  std::filesystem::path const& path() const { return path_; }  // for words
  int descriptor() const { return descriptor_; }
  std::uint64_t size() const { return size_; }  // as it was opened

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::uint64_t size_ = 0;
};

// all of them, from `offset` on; false when there are not so many (errno is 0) or the disk fails
bool read_at(int descriptor, std::uint64_t offset, void* data, std::size_t size);

}  // namespace torquescope
