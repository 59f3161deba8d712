#include "engine/store/temp_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

std::string reason_of(int error_number) {
  std::string text = std::strerror(error_number);
  text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
  return text;
}

std::string help_for(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      return "make room there (or choose another folder) and run the same command again";
    case EFBIG:
      return "raise the limit on file sizes (ulimit -f) and run the same command again";
    case ENOENT:
      return "make the folder first, or write to another one";
    case EACCES:
    case EPERM:
    case EROFS:
      return "write to a folder that is yours";
    default:
      return "check the disk, or write to another folder";
  }
}

Error cannot_write(fs::path const& name, int error_number) {
  Problem problem{.code = ExitCode::io,
                  .what = fmt::format("cannot write {}: {}", name.string(), reason_of(error_number))};
  if (error_number == ENOSPC || error_number == EDQUOT) {
    std::error_code ignored;
    fs::space_info const space = fs::space(name.has_parent_path() ? name.parent_path() : fs::path("."), ignored);
    if (!ignored) problem.notes = {fmt::format("{:.1f} MB are free there", static_cast<double>(space.available) / 1e6)};
  }
  problem.help = help_for(error_number);
  return Error(problem);
}

// a rename is safe only when the folder that holds the name is
int sync_folder(fs::path const& folder) {
  int const descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  int error_number = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  // some network file systems have no fsync for folders: they keep names safe themselves
  return error_number == EINVAL ? 0 : error_number;
}

}  // namespace

TempFile::TempFile(fs::path final_name) : final_name_(std::move(final_name)) {
  std::error_code ignored;
  validate(!fs::is_directory(final_name_, ignored), [&] {
    return Problem{.code = ExitCode::exists,
                   .what = final_name_.string() + " is a folder, not a file",
                   .help = "name a file in it: " + (final_name_ / "result.h5").string()};
  });

  constexpr int attempts = 1000;
  constexpr mode_t anybody_as_umask_allows = 0666;
  for (int i = 0; i < attempts && descriptor_ < 0; ++i) {
    temporary_name_ = fmt::format("{}.tmp.{}{}", final_name_.string(), ::getpid(), i ? fmt::format(".{}", i) : "");
    descriptor_ =
        ::open(temporary_name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, anybody_as_umask_allows);
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ < 0) throw cannot_write(final_name_, errno);
}

TempFile::~TempFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_name_.c_str());
}

void TempFile::write_at(std::uint64_t offset, void const* data, std::size_t size) noexcept {
  size_ = std::max(size_, offset + size);
  auto const* bytes = static_cast<char const*>(data);
  while (size > 0 && !failed()) {
    ssize_t const written = ::pwrite(descriptor_, bytes, size, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      error_number_ = written < 0 ? errno : EIO;
      return;
    }
    bytes += written;
    offset += static_cast<std::uint64_t>(written);
    size -= static_cast<std::size_t>(written);
  }
}

bool TempFile::read_at(std::uint64_t offset, void* data, std::size_t size) const noexcept {
  auto* bytes = static_cast<char*>(data);
  while (size > 0) {
    ssize_t const got = ::pread(descriptor_, bytes, size, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return false;
    if (got == 0) {
      std::memset(bytes, 0, size);
      return true;
    }
    bytes += got;
    offset += static_cast<std::uint64_t>(got);
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

void TempFile::resize(std::uint64_t size) noexcept {
  size_ = size;
  if (!failed() && ::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) error_number_ = errno;
}

void TempFile::check() const {
  if (failed()) throw cannot_write(final_name_, error_number_);
}

void TempFile::publish() {
  TORQUESCOPE_EXPECT(descriptor_ >= 0);
  // an fsync that failed is never tried again: the second one would not tell what the first one lost
  if (!failed() && ::fsync(descriptor_) != 0) error_number_ = errno;
  check();
  if (::rename(temporary_name_.c_str(), final_name_.c_str()) != 0) error_number_ = errno;
  check();

  ::close(std::exchange(descriptor_, -1));
  error_number_ = sync_folder(final_name_.has_parent_path() ? final_name_.parent_path() : fs::path("."));
  check();
}

}  // namespace torquescope
