#include "engine/store/temp_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"
#include "engine/base/interrupted_call.hpp"
#include "engine/store/disk_failure.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t block_bytes = std::size_t{1} << 19;
// more would be memory that is written for the first time, which costs more than waiting for the disk now and then
constexpr std::size_t most_waiting_blocks = 2;
// A smaller file is not worth a thread: starting it, and taking turns with it, costs 1 of 16 ms of processor time for
// one of 5 MB, and saves 2 ms of waiting
constexpr std::uintmax_t worth_a_thread = std::uintmax_t{8} << 20;
constexpr std::size_t page = 4096;
// below, waiting for the disk costs more than the page cache
constexpr std::size_t least_direct_bytes = std::size_t{64} << 10;

int open_file(int folder, std::string const& name, int flags, mode_t mode = 0) {
  return unless_interrupted([&] { return ::openat(folder, name.c_str(), flags, mode); });
}

int sync_file(int descriptor) {
  return unless_interrupted([&] { return ::fsync(descriptor); });
}

// Linux has closed the descriptor whatever close() says. Returns errno of a failure
int close_file(int descriptor) { return ::close(descriptor) == 0 || errno == EINTR ? 0 : errno; }

// some network file systems have no fsync for folders: they keep names safe themselves
int sync_open_folder(int descriptor) { return sync_file(descriptor) == 0 || errno == EINVAL ? 0 : errno; }

bool is_folder(FilePlace const& place) {
  struct stat facts {};
  return ::fstatat(place.folder, place.name.c_str(), &facts, 0) == 0 && S_ISDIR(facts.st_mode);
}

}  // namespace

int sync_folder_of(fs::path const& name) {
  fs::path const folder = name.has_parent_path() ? name.parent_path() : fs::path(".");
  int const descriptor = open_file(AT_FDCWD, folder.native(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  int const error_number = sync_open_folder(descriptor);
  static_cast<void>(close_file(descriptor));  // nothing was written through it
  return error_number;
}

int TempFile::sync_folder() const {
  return place_.folder == AT_FDCWD ? sync_folder_of(place_.path) : sync_open_folder(place_.folder);
}

TempFile::TempFile(FilePlace place, std::uintmax_t expected_bytes)
    : place_(std::move(place)),
      expected_bytes_(expected_bytes),
      writer_([this](FilePiece const& piece) { return write_piece(piece.offset, piece.bytes.data(), piece.size); },
              expected_bytes > 0 && expected_bytes < worth_a_thread ? 0 : most_waiting_blocks) {
  validate(!is_folder(place_), [&] {
    return Problem{.code = ExitCode::exists,
                   .what = place_.path.string() + " is a folder, not a file",
                   .help = "name a file in it: " + (place_.path / "result.h5").string()};
  });

  constexpr int attempts = 1000;
  constexpr mode_t anybody_as_umask_allows = 0666;
  for (int i = 0; i < attempts && descriptor_ < 0; ++i) {
    ending_ = fmt::format(".tmp.{}{}", ::getpid(), i ? fmt::format(".{}", i) : "");
    constexpr int new_file = O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
    descriptor_ = open_file(place_.folder, temporary(), new_file, anybody_as_umask_allows);
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ < 0) throw cannot_write(place_.path, errno, expected_bytes_);
  // where there are no locks, nothing is lost but a hint for whoever tidies up
  static_cast<void>(::flock(descriptor_, LOCK_EX | LOCK_NB));
}

TempFile::~TempFile() {
  if (descriptor_ < 0) return;
  ::unlinkat(place_.folder, temporary().c_str(), 0);
  writer_.stop();
  ::close(descriptor_);
}

// whole pages go to the disk directly: the page cache costs more than everything else that storing does
bool TempFile::write_past_cache(bool wanted) {
  wanted = wanted && may_bypass_;
  if (wanted == past_cache_) return past_cache_;
  int const flags = ::fcntl(descriptor_, F_GETFL);
  if (::fcntl(descriptor_, F_SETFL, wanted ? flags | O_DIRECT : flags & ~O_DIRECT) == 0)
    past_cache_ = wanted;
  else
    may_bypass_ = false;
  return past_cache_;
}

// returns errno of a failure
int TempFile::write_piece(std::uint64_t offset, std::byte const* bytes, std::size_t size) {
  while (size > 0) {
    bool const direct = write_past_cache(size >= least_direct_bytes && offset % page == 0 && size % page == 0);
    ssize_t const written = ::pwrite(descriptor_, bytes, size, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EINVAL && direct && std::exchange(may_bypass_, false)) continue;
    if (written <= 0) return written < 0 ? errno : EIO;
    bytes += written;
    offset += static_cast<std::uint64_t>(written);
    size -= static_cast<std::size_t>(written);
  }
  return 0;
}

std::size_t TempFile::tail_room() const { return block_bytes - tail_.offset % block_bytes; }

void TempFile::start_tail() {
  if (!tail_.bytes.data()) tail_.bytes = writer_.memory(block_bytes);
}

void TempFile::hand_over_tail() {
  std::uint64_t const end = tail_end();
  if (tail_.size > 0 && tail_.offset == 0)
    head_ = std::exchange(tail_, {});
  else if (tail_.size > 0)
    writer_.put(std::exchange(tail_, {}));
  tail_.offset = end;
  tail_.size = 0;
}

// in front of the tail
void TempFile::write_behind(std::uint64_t offset, std::byte const* bytes, std::size_t size) {
  if (offset < head_.size) {
    std::size_t const part = std::min(size, head_.size - static_cast<std::size_t>(offset));
    std::memcpy(head_.bytes.data() + offset, bytes, part);
    bytes += part;
    offset += part;
    size -= part;
  }
  if (size == 0) return;
  writer_.wait();
  if (!failed()) error_number_ = write_piece(offset, bytes, size);
}

// whole pages past the cache
void TempFile::write_out(FilePiece const& piece) {
  std::size_t const whole_pages = piece.size / page * page;
  if (!failed()) error_number_ = write_piece(piece.offset, piece.bytes.data(), whole_pages);
  if (!failed())
    error_number_ = write_piece(piece.offset + whole_pages, piece.bytes.data() + whole_pages, piece.size - whole_pages);
}

// bytes: nullptr for zeros
void TempFile::write_tail(std::uint64_t offset, std::byte const* bytes, std::size_t size) {
  while (size > 0 && !failed()) {
    start_tail();
    if (offset - tail_.offset >= tail_room()) {
      hand_over_tail();
      continue;
    }
    std::size_t const place = static_cast<std::size_t>(offset - tail_.offset);
    std::size_t const part = std::min(size, tail_room() - place);
    if (bytes)
      std::memcpy(tail_.bytes.data() + place, bytes, part);
    else
      std::memset(tail_.bytes.data() + place, 0, part);
    tail_.size = std::max(tail_.size, place + part);
    if (bytes) bytes += part;
    offset += part;
    size -= part;
  }
}

void TempFile::write_at(std::uint64_t offset, void const* data, std::size_t size) noexcept {
  size_ = std::max(size_, offset + size);
  auto const* bytes = static_cast<std::byte const*>(data);
  try {
    if (failed()) return;
    if (offset < tail_.offset) {
      auto const part = static_cast<std::size_t>(std::min<std::uint64_t>(size, tail_.offset - offset));
      write_behind(offset, bytes, part);
      bytes += part;
      offset += part;
      size -= part;
    }
    // nothing was ever written beyond the tail: what is skipped is zero until it comes
    if (size > 0 && offset > tail_end()) write_tail(tail_end(), nullptr, static_cast<std::size_t>(offset - tail_end()));
    write_tail(offset, bytes, size);
  } catch (std::bad_alloc const&) {
    error_number_ = ENOMEM;
  }
}

bool TempFile::read_at(std::uint64_t offset, void* data, std::size_t size) noexcept {
  auto* bytes = static_cast<char*>(data);
  std::memset(bytes, 0, size);
  if (offset + size > tail_.offset) {
    std::uint64_t const begin = std::max(offset, tail_.offset), end = std::min(offset + size, tail_end());
    if (begin < end) std::memcpy(bytes + (begin - offset), tail_.bytes.data() + (begin - tail_.offset), end - begin);
    size = offset < tail_.offset ? static_cast<std::size_t>(tail_.offset - offset) : 0;
  }
  if (offset < head_.size) {
    std::size_t const part = std::min(size, head_.size - static_cast<std::size_t>(offset));
    std::memcpy(bytes, head_.bytes.data() + offset, part);
    bytes += part;
    offset += part;
    size -= part;
  }
  if (size == 0) return true;
  writer_.wait();
  write_past_cache(false);
  while (size > 0) {
    ssize_t const got = ::pread(descriptor_, bytes, size, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return false;
    if (got == 0) return true;
    bytes += got;
    offset += static_cast<std::uint64_t>(got);
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

void TempFile::resize(std::uint64_t size) noexcept {
  if (size > size_) return write_at(size - 1, "", 1);
  size_ = size;
  if (size >= tail_.offset) {
    tail_.size = static_cast<std::size_t>(size - tail_.offset);
    return;
  }
  writer_.wait();
  auto const cut = [&] { return ::ftruncate(descriptor_, static_cast<off_t>(size)); };
  if (!failed() && unless_interrupted(cut) != 0) error_number_ = errno;
  head_.size = std::min(head_.size, static_cast<std::size_t>(size));
  tail_.offset = size;
  tail_.size = 0;
}

void TempFile::check() const {
  if (failed()) throw cannot_write(place_.path, error_number(), std::max<std::uintmax_t>(expected_bytes_, size_));
}

void TempFile::publish() {
  TORQUESCOPE_EXPECT(descriptor_ >= 0);
  if (!failed()) {
    writer_.wait();
    write_out(head_);
    write_out(tail_);
  }
  // an fsync that failed is never tried again: the second one would not tell what the first one lost
  if (!failed() && sync_file(descriptor_) != 0) error_number_ = errno;
  check();
  if (::renameat(place_.folder, temporary().c_str(), place_.folder, place_.name.c_str()) != 0) error_number_ = errno;
  check();

  error_number_ = close_file(std::exchange(descriptor_, -1));
  check();
  error_number_ = sync_folder();
  check();
}

}  // namespace torquescope
