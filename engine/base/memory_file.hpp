#pragma once
// Bytes as a file without a name, for libraries that read only paths; it goes when the object does.
//
// Errors     Error 74 when there is no memory for it
// Threads    an object belongs to one thread at a time; its path holds in this process and in children that it forks

#include <string>
#include <string_view>

namespace torquescope {

class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes);
  ~MemoryFile();
  MemoryFile(MemoryFile const&) = delete;
  MemoryFile& operator=(MemoryFile const&) = delete;
  std::string path() const;

 private:
  int descriptor_;
};

}  // namespace torquescope
