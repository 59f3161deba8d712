#include "engine/store/disk_writer.hpp"

#include <signal.h>  // NOLINT(modernize-deprecated-headers): pthread_sigmask is POSIX, <csignal> does not promise it

#include <cstdlib>
#include <new>
#include <system_error>
#include <utility>

#include "engine/base/huge_pages.hpp"
#include "engine/base/wait_until_true.hpp"

namespace torquescope {
namespace {

constexpr std::size_t page = 4096;

}  // namespace

PageAlignedBytes::PageAlignedBytes(std::size_t size)
    : bytes_(static_cast<std::byte*>(std::aligned_alloc(page, (size + page - 1) / page * page))) {
  if (!bytes_) throw std::bad_alloc();
  ask_for_huge_pages({bytes_.get(), size});
}

// NOLINTNEXTLINE(cppcoreguidelines-no-malloc): what aligned_alloc() gave
void PageAlignedBytes::Free::operator()(std::byte* bytes) const noexcept { std::free(bytes); }

DiskWriter::DiskWriter(Sink sink, std::size_t most_waiting) : sink_(std::move(sink)), most_waiting_(most_waiting) {
  written_.reserve(most_waiting);
}

DiskWriter::~DiskWriter() { stop(); }

void DiskWriter::stop() {
  if (!thread_.joinable()) return;
  {
    std::lock_guard const lock(guard_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void DiskWriter::start() {
  // a signal is for the thread that waits for it
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  try {
    thread_ = std::thread([this] { run(); });
  } catch (std::system_error const&) {  // put() writes without
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void DiskWriter::write(FilePiece& piece) {
  if (error() == 0) error_ = sink_(piece);
}

void DiskWriter::put(FilePiece piece) {
  if (error() != 0) return;
  if (!thread_.joinable() && most_waiting_ > 0) start();
  if (!thread_.joinable()) {
    write(piece);
    written_.push_back(std::move(piece.bytes));
    return;
  }
  {
    std::unique_lock lock(guard_);
    wait_until_true(changed_, lock, [this] { return waiting_.size() < most_waiting_; });
    waiting_.push_back(std::move(piece));
  }
  changed_.notify_all();
}

void DiskWriter::run() {
  std::unique_lock lock(guard_);
  for (;;) {
    wait_until_true(changed_, lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_) return;
    FilePiece& piece = waiting_.front();  // a deque moves nothing when more is put behind it
    lock.unlock();
    write(piece);
    lock.lock();
    written_.push_back(std::move(piece.bytes));
    waiting_.pop_front();
    changed_.notify_all();
  }
}

void DiskWriter::wait() {
  std::unique_lock lock(guard_);
  wait_until_true(changed_, lock, [this] { return waiting_.empty(); });
}

PageAlignedBytes DiskWriter::memory(std::size_t room) {
  std::lock_guard const lock(guard_);
  if (written_.empty()) return PageAlignedBytes(room);
  PageAlignedBytes bytes = std::move(written_.back());
  written_.pop_back();
  return bytes;
}

}  // namespace torquescope
