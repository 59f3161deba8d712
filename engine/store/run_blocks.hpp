#pragma once
// Runs of one dataset, given in any order, handed on as whole blocks of neighbouring runs.
//
// Why        small runs share a chunk; a chunk that is written once needs no cache and is digested once
// Shapes     a block is `in_block` runs, the last one what is left; each run has the same number of bytes
// Memory     the blocks that are begun and not yet whole: one, when runs come in order
// Threads    one at a time

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

namespace torquescope {

class RunBlocks {
 public:
  // runs [first, first + count) and their values
  using Emit = std::function<void(std::size_t first, std::size_t count, std::span<std::byte const> values)>;

  // absent: the eight bytes of each value of a run that never comes
  RunBlocks(std::size_t runs, std::size_t bytes_of_run, std::size_t in_block, std::uint64_t absent);

  // of one or more neighbouring runs from `run` on; not twice for the same one. A block that they make up is handed on
  // without a copy
  void put(std::size_t run, std::span<std::byte const> values, Emit const& emit);
  // the last run of its block
  bool ends_block(std::size_t run) const { return (run + 1) % in_block_ == 0 || run + 1 == runs_; }
  // whatever is not whole, with its absent runs
  void put_rest(Emit const& emit);

 private:
  struct Block {
    std::vector<std::byte> values;
    std::vector<bool> has;
    std::size_t missing = 0;
  };

  std::size_t runs_in(std::size_t block) const;
  Block& begun(std::size_t block);
  void put_into(std::size_t index, std::size_t place, std::span<std::byte const> values, Emit const& emit);
  void emit_block(std::size_t block, std::span<std::byte const> values, Emit const& emit);

  std::size_t runs_, bytes_of_run_, in_block_;
  std::uint64_t absent_;
  std::map<std::size_t, Block> begun_;
  std::vector<bool> emitted_;  // per block
  std::vector<std::byte> spare_;
};

}  // namespace torquescope
