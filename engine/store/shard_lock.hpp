#pragma once
// Two processes at the same share of a job do its work twice: the second one is told so and ends. Nothing more depends
// on it: segments have names of their own (segment_folder.hpp), so what two processes write is safe with it and without
// it.
//
// File       RESULT.parts/shard-<I>-of-<N>.lock, locked (flock) as long as its process lives; it says who that is
// Locks      where there are none (some network file systems), or where the file cannot be made, both go on
// Errors     73 when a living process holds it, or the folder is not ours (own_folder.hpp)
// Threads    one at a time

#include <filesystem>
#include <string>

#include "engine/store/own_folder.hpp"
#include "engine/store/segment_folder.hpp"

namespace torquescope {

// whether an open file says what locks say: nothing, who holds it, or, after a power cut, zeros. Anything else under a
// lock's name is somebody's own file
bool is_lock_file(int descriptor);

class ShardLock {
 public:
  ShardLock(std::filesystem::path const& result, ShardChoice const& shard);
  ~ShardLock();  // takes its file away, and the folder when nothing else is in it
  ShardLock(ShardLock const&) = delete;
  ShardLock& operator=(ShardLock const&) = delete;

 private:
  OwnFolder folder_;
  std::string file_;
  int descriptor_ = -1;
};

}  // namespace torquescope
