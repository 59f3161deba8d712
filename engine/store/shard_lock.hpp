#pragma once
// Two processes at the same share of a job do its work twice: the second one is told so and ends. Nothing more depends
// on it: segments have names of their own (segment_folder.hpp), so what two processes write is safe with it and without
// it.
//
// File       RESULT.parts/shard-<I>-of-<N>.lock, locked (flock) as long as its process lives; its first line says who
// that is, the rest is what say() was told last
// Locks      where there are none (some network file systems), or where the file cannot be made, both go on
// By force   a process that ends without its destructors calls drop_held_lock() first
// Errors     73 when a living process holds it, or the folder is not ours (own_folder.hpp)
// Threads    one at a time

#include <filesystem>
#include <string>
#include <vector>

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

  // below the first line, for whoever looks at the lock; a disk that fails is told of by those who must write
  void say(std::string const& text) const;

 private:
  OwnFolder folder_;
  std::string file_;
  std::string who_;
  int descriptor_ = -1;
};

// takes the file of this process's lock away, and the folder when nothing else is in it; nothing when it holds none. Of
// several locks it is the one made last. For signal handlers: calls nothing that they may not (signal-safety(7))
void drop_held_lock() noexcept;

// a lock as it stands in a folder of segments
struct LockWords {
  std::string who;        // "process 4711 on node7"
  std::string said;       // "" when its process told nothing
  bool is_alive = false;  // its process holds it: known on this host, and where the file system knows locks
};
std::vector<LockWords> locks_in(std::filesystem::path const& segment_folder);

}  // namespace torquescope
