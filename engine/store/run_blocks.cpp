#include "engine/store/run_blocks.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {

RunBlocks::RunBlocks(std::size_t runs, std::size_t bytes_of_run, std::size_t in_block, std::uint64_t absent)
    : runs_(runs),
      bytes_of_run_(bytes_of_run),
      in_block_(in_block),
      absent_(absent),
      emitted_((runs + in_block - 1) / in_block) {
  TORQUESCOPE_EXPECT(bytes_of_run % sizeof(absent) == 0);
}

std::size_t RunBlocks::runs_in(std::size_t block) const { return std::min(in_block_, runs_ - block * in_block_); }

RunBlocks::Block& RunBlocks::begun(std::size_t block) {
  auto const [place, is_new] = begun_.try_emplace(block);
  Block& started = place->second;
  if (is_new) {
    started.values = std::exchange(spare_, {});
    started.values.resize(runs_in(block) * bytes_of_run_);
    for (std::size_t at = 0; at < started.values.size(); at += sizeof(absent_))
      std::memcpy(&started.values[at], &absent_, sizeof(absent_));
    started.has.assign(runs_in(block), false);
    started.missing = runs_in(block);
  }
  return started;
}

void RunBlocks::emit_block(std::size_t block, std::span<std::byte const> values, Emit const& emit) {
  TORQUESCOPE_EXPECT(!emitted_[block]);
  emit(block * in_block_, runs_in(block), values);
  emitted_[block] = true;
}

void RunBlocks::put(std::size_t run, std::span<std::byte const> values, Emit const& emit) {
  TORQUESCOPE_EXPECT(bytes_of_run_ > 0 && values.size() % bytes_of_run_ == 0);
  std::size_t const end = run + values.size() / bytes_of_run_;
  TORQUESCOPE_EXPECT(end <= runs_);
  while (run < end) {
    std::size_t const index = run / in_block_, count = std::min(end, index * in_block_ + runs_in(index)) - run;
    auto const part = values.first(count * bytes_of_run_);
    TORQUESCOPE_EXPECT(count < runs_in(index) || !begun_.contains(index));
    if (count == runs_in(index))
      emit_block(index, part, emit);
    else
      put_into(index, run % in_block_, part, emit);
    run += count;
    values = values.subspan(part.size());
  }
}

void RunBlocks::put_into(std::size_t index, std::size_t place, std::span<std::byte const> values, Emit const& emit) {
  TORQUESCOPE_EXPECT(!emitted_[index]);
  Block& block = begun(index);
  std::size_t const count = values.size() / bytes_of_run_;
  auto const has = block.has.begin() + static_cast<std::ptrdiff_t>(place);
  TORQUESCOPE_EXPECT(std::none_of(has, has + static_cast<std::ptrdiff_t>(count), [](bool one) { return one; }));
  std::fill_n(has, count, true);
  std::copy(values.begin(), values.end(), block.values.begin() + static_cast<std::ptrdiff_t>(place * bytes_of_run_));
  block.missing -= count;
  if (block.missing > 0) return;
  emit_block(index, block.values, emit);
  spare_ = std::move(block.values);
  begun_.erase(index);
}

void RunBlocks::put_rest(Emit const& emit) {
  for (std::size_t index = 0; index < emitted_.size(); ++index) {
    if (emitted_[index]) continue;
    emit_block(index, begun(index).values, emit);
    spare_ = std::move(begun(index).values);
    begun_.erase(index);
  }
}

}  // namespace torquescope
