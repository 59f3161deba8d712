#pragma once
// Members that better trials replaced: their differences to the living keep a population that converges diverse.
//
// Random     one draw per member that leaves: whichever
// Source     Zhang, Sanderson: JADE, IEEE TEC 13 (2009), section IV-A

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/random_stream.hpp"

namespace torquescope {

class MemberArchive {
 public:
  explicit MemberArchive(std::size_t dimension) : dimension_(dimension) {}

  std::size_t size() const { return numbers_.size() / dimension_; }
  std::span<double const> row(std::size_t i) const { return {numbers_.data() + i * dimension_, dimension_}; }

  // in the place of another once there are `most`
  void add(std::span<double const> member, std::size_t most, RandomStream& random) {
    TORQUESCOPE_EXPECT(member.size() == dimension_);
    if (most == 0) return;
    shrink(most, random);
    if (size() < most) {
      numbers_.insert(numbers_.end(), member.begin(), member.end());
      return;
    }
    std::copy(member.begin(), member.end(), place(random.below(static_cast<std::uint32_t>(size()))));
  }

  void shrink(std::size_t most, RandomStream& random) {
    while (size() > most) {
      std::size_t const leaving = random.below(static_cast<std::uint32_t>(size()));
      std::copy_n(place(size() - 1), dimension_, place(leaving));
      numbers_.resize(numbers_.size() - dimension_);
    }
  }

  std::vector<double> const& numbers() const { return numbers_; }
  void restore(std::vector<double> numbers) { numbers_ = std::move(numbers); }

 private:
  std::vector<double>::iterator place(std::size_t i) {
    return numbers_.begin() + static_cast<std::ptrdiff_t>(i * dimension_);
  }

  std::size_t dimension_;
  std::vector<double> numbers_;
};

}  // namespace torquescope
