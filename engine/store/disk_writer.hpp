#pragma once
// Takes blocks of a file to the disk in a thread of its own, so that computing goes on meanwhile.
//
// Order      pieces reach the sink one at a time, in the order in which they were put
// Memory     at most `most_waiting` pieces wait or are being written (put() waits for room), as many wait to be used
//            again
// Errors     the sink says the errno of its failure; the first one is remembered, everything behind it is dropped.
//            put() and wait() then return at once, they never fail themselves. Where no thread can be started, or
//            nothing shall wait, put() writes in the caller's
// Threads    put() and wait() by one thread; the sink is called by one other, which takes no signals. The destructor
//            is stop()

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

namespace torquescope {

// memory that begins at a page, as direct writing wants it
class PageAlignedBytes {
 public:
  PageAlignedBytes() = default;
  explicit PageAlignedBytes(std::size_t size);
  std::byte* data() const { return bytes_.get(); }

 private:
  struct Free {
    void operator()(std::byte* bytes) const noexcept;
  };
  std::unique_ptr<std::byte, Free> bytes_;
};

struct FilePiece {
  std::uint64_t offset = 0;
  std::size_t size = 0;
  PageAlignedBytes bytes;
};

class DiskWriter {
 public:
  using Sink = std::function<int(FilePiece const&)>;

  DiskWriter(Sink sink, std::size_t most_waiting);
  ~DiskWriter();
  DiskWriter(DiskWriter const&) = delete;
  DiskWriter& operator=(DiskWriter const&) = delete;

  void put(FilePiece piece);
  void wait();                                 // until everything put has reached the sink
  int error() const { return error_.load(); }  // errno of the first failure, 0 when there is none
  void stop();  // drops what waits; returns when the piece being written is done. put() is over then
  // memory for a piece: that of one already written, if there is one. All pieces of one writer have the same room
  PageAlignedBytes memory(std::size_t room);

 private:
  void start();
  void run();
  void write(FilePiece& piece);

  Sink sink_;
  std::size_t most_waiting_;
  std::atomic<int> error_{0};
  std::mutex guard_;
  std::condition_variable changed_;
  std::deque<FilePiece> waiting_;  // the first one may be on its way
  std::vector<PageAlignedBytes> written_;
  bool ending_ = false;
  std::thread thread_;  // started with the first piece
};

}  // namespace torquescope
