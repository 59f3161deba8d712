// The thread that writes: order, room, failures, giving up; none of it depends on how fast the disk is.

#include "engine/store/disk_writer.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <set>

namespace torquescope {
namespace disk_writer_test {

constexpr std::size_t room = 8192;

FilePiece piece(DiskWriter& writer, std::uint64_t offset) {
  FilePiece made{offset, room, writer.memory(room)};
  made.bytes.data()[0] = static_cast<std::byte>(offset);
  return made;
}

// a disk that does nothing until it is told to
class StuckDisk {
 public:
  int operator()(FilePiece const& piece) {
    std::unique_lock lock(guard_);
    ++begun_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return allowed_ > 0; });
    --allowed_;
    offsets_.push_back(piece.offset);
    return 0;
  }
  void allow(int pieces) {
    std::lock_guard const lock(guard_);
    allowed_ += pieces;
    changed_.notify_all();
  }
  void wait_until_begun(int pieces) {
    std::unique_lock lock(guard_);
    changed_.wait(lock, [&] { return begun_ >= pieces; });
  }
  std::vector<std::uint64_t> offsets() {
    std::lock_guard const lock(guard_);
    return offsets_;
  }

 private:
  std::mutex guard_;
  std::condition_variable changed_;
  int begun_ = 0, allowed_ = 0;
  std::vector<std::uint64_t> offsets_;
};

TEST(DiskWriter, WritesInTheOrderOfPuttingAndOneAtATime) {
  std::vector<std::uint64_t> seen;
  std::atomic<int> inside{0};
  DiskWriter writer(
      [&](FilePiece const& written) {
        EXPECT_EQ(inside.fetch_add(1), 0);
        EXPECT_EQ(written.bytes.data()[0], static_cast<std::byte>(written.offset));
        seen.push_back(written.offset);
        inside.fetch_sub(1);
        return 0;
      },
      3);
  std::vector<std::uint64_t> put;
  for (std::uint64_t i = 0; i < 500; ++i) {
    put.push_back(i * 7919 % 251);
    writer.put(piece(writer, put.back()));
  }
  writer.wait();
  EXPECT_EQ(seen, put);
  EXPECT_EQ(writer.error(), 0);
}

TEST(DiskWriter, WritesAtOnceWhereNothingShallWait) {
  std::vector<std::uint64_t> seen;
  DiskWriter writer(
      [&, caller = std::this_thread::get_id()](FilePiece const& written) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        seen.push_back(written.offset);
        return written.offset == 4 ? EIO : 0;
      },
      0);
  FilePiece first = piece(writer, 1);
  std::byte const* const memory = first.bytes.data();
  writer.put(std::move(first));
  EXPECT_EQ(seen, std::vector<std::uint64_t>{1});
  FilePiece second = piece(writer, 4);
  EXPECT_EQ(second.bytes.data(), memory);  // used again
  writer.put(std::move(second));
  EXPECT_EQ(writer.error(), EIO);
  writer.put(piece(writer, 5));
  writer.wait();
  EXPECT_EQ(seen, (std::vector<std::uint64_t>{1, 4}));
}

TEST(DiskWriter, LetsTheCallerGoOnUntilTheRoomIsUsedUp) {
  StuckDisk disk;
  DiskWriter writer([&](FilePiece const& written) { return disk(written); }, 3);
  for (std::uint64_t i = 0; i < 3; ++i) writer.put(piece(writer, i));  // does not block though nothing is written
  disk.wait_until_begun(1);
  EXPECT_TRUE(disk.offsets().empty());

  std::atomic<bool> fourth_was_put{false};
  std::thread caller([&] {
    writer.put(piece(writer, 3));
    fourth_was_put = true;
  });
  // the caller has every chance to be wrong, and no way to be right, before a piece is written
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(fourth_was_put);
  disk.allow(1);
  caller.join();
  EXPECT_TRUE(fourth_was_put);
  disk.allow(3);
  writer.wait();
  EXPECT_EQ(disk.offsets(), (std::vector<std::uint64_t>{0, 1, 2, 3}));
}

TEST(DiskWriter, UsesNoMoreMemoryThanItsRoom) {
  DiskWriter writer([](FilePiece const&) { return 0; }, 3);
  std::set<std::byte*> addresses;
  for (std::uint64_t i = 0; i < 200; ++i) {
    FilePiece made = piece(writer, i);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(made.bytes.data()) % 4096, 0U);
    addresses.insert(made.bytes.data());
    writer.put(std::move(made));
  }
  writer.wait();
  // three waiting and the one in hand
  EXPECT_LE(addresses.size(), 4U);
}

TEST(DiskWriter, RemembersTheFirstFailureAndDropsWhatFollows) {
  std::vector<std::uint64_t> tried;
  DiskWriter writer(
      [&](FilePiece const& written) {
        tried.push_back(written.offset);
        return written.offset == 5 ? ENOSPC : 0;
      },
      2);
  for (std::uint64_t i = 0; i < 100; ++i) writer.put(piece(writer, i));  // never blocks for ever
  writer.wait();
  EXPECT_EQ(writer.error(), ENOSPC);
  EXPECT_EQ(tried, (std::vector<std::uint64_t>{0, 1, 2, 3, 4, 5}));
}

TEST(DiskWriter, GivesUpWithoutWritingWhatWaits) {
  StuckDisk disk;
  {
    DiskWriter writer([&](FilePiece const& written) { return disk(written); }, 4);
    for (std::uint64_t i = 0; i < 4; ++i) writer.put(piece(writer, i));
    disk.wait_until_begun(1);
    std::thread later([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      disk.allow(1);
    });
    writer.stop();
    later.join();
  }
  EXPECT_EQ(disk.offsets(), (std::vector<std::uint64_t>{0}));
}

TEST(DiskWriter, NeedsNoThreadWhenNothingIsPut) {
  DiskWriter writer([](FilePiece const&) { return EIO; }, 2);
  writer.wait();
  EXPECT_EQ(writer.error(), 0);
}

}  // namespace disk_writer_test
}  // namespace torquescope
