#include "engine/base/memory_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "engine/base/error.hpp"

namespace torquescope {

MemoryFile::MemoryFile(std::string_view bytes) : descriptor_(::memfd_create("torquescope", MFD_CLOEXEC)) {
  bool written = descriptor_ >= 0;
  while (written && !bytes.empty()) {
    auto const count = ::write(descriptor_, bytes.data(), bytes.size());
    written = count > 0 || errno == EINTR;
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  int const error = errno;
  if (written) return;
  if (descriptor_ >= 0) ::close(descriptor_);
  throw Error(Problem{ExitCode::io, std::string("no memory to unpack a file: ") + std::strerror(error)});
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::string MemoryFile::path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

}  // namespace torquescope
