#include "engine/store/read_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/interrupted_call.hpp"
#include "engine/store/disk_failure.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

Error not_a_file(fs::path const& path) {
  return Error(
      Problem{.code = ExitCode::bad_data, .what = path.string() + " is not a file", .help = "name a result file"});
}

bool means_absent(int error_number) { return error_number == ENOENT || error_number == ENOTDIR; }

}  // namespace

ReadFile::ReadFile(FilePlace const& place) : path_(place.path), descriptor_(-1) {
  struct stat facts {};
  // before it is opened: a pipe would hang, a device could do anything
  int const link_flag = place.is_in_open_folder() ? AT_SYMLINK_NOFOLLOW : 0;
  if (::fstatat(place.folder, place.name.c_str(), &facts, link_flag) != 0)
    throw means_absent(errno) ? no_such_result(path_) : cannot_read(path_, errno);
  if (!S_ISREG(facts.st_mode)) throw not_a_file(path_);
  int const flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | (place.is_in_open_folder() ? O_NOFOLLOW : 0);
  descriptor_ = unless_interrupted([&] { return ::openat(place.folder, place.name.c_str(), flags); });
  if (descriptor_ < 0) throw means_absent(errno) ? no_such_result(path_) : cannot_read(path_, errno);
  // another one may have got its name meanwhile
  bool const is_file = ::fstat(descriptor_, &facts) == 0 && S_ISREG(facts.st_mode);
  if (!is_file) {
    ::close(descriptor_);
    throw not_a_file(path_);
  }
  size_ = static_cast<std::uint64_t>(facts.st_size);
}

ReadFile::~ReadFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

ReadFile::ReadFile(ReadFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

bool read_at(int descriptor, std::uint64_t offset, void* data, std::size_t size) {
  auto* bytes = static_cast<char*>(data);
  while (size > 0) {
    ssize_t const got =
        unless_interrupted([&] { return ::pread(descriptor, bytes, size, static_cast<off_t>(offset)); });
    if (got == 0) errno = 0;
    if (got <= 0) return false;
    bytes += got;
    offset += static_cast<std::uint64_t>(got);
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace torquescope
