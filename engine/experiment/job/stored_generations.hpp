#pragma once
// Which generations of each run a result stores: [output] history = "full", "every 10" or "last".
//
// Entries    "full": every generation; "every k": 0, k, 2 k, ... and the last that a run may have; "last": that alone
// Early end  the first entry behind a run's own last generation stands for that one, so no run loses its end; entries
//            behind it stand for nothing, as in a full history
// Threads    immutable value

#include <cstddef>
#include <optional>
#include <string>

namespace torquescope {

class StoredGenerations {
 public:
  // of runs with so many generations behind the initial one; nothing where the word is none of these
  static std::optional<StoredGenerations> of(std::string const& word, std::size_t generations);

  std::size_t count() const;
  bool all() const { return count() == generations_ + 1; }
  // of an entry, in a run that goes to its end
  std::size_t number(std::size_t entry) const;
  // of an entry, in a run that has generations [0, told)
  std::optional<std::size_t> in_run(std::size_t entry, std::size_t told) const;

 private:
  StoredGenerations(std::size_t step, std::size_t generations) : step_(step), generations_(generations) {}

  std::size_t step_;  // 0: the last alone
  std::size_t generations_;
};

}  // namespace torquescope
