#pragma once
// Sums vectors that arrive one after the other in a fixed binary tree: neighbours, then neighbours of neighbours.
//
// Equation   S(first, count) = S(first, half) + S(first + half, count - half), half the largest power of two < count
// Why        the bits depend only on the number of terms; error grows with its logarithm; log2 partial sums are held
// Threads    one per thread; does not allocate

#include <bit>
#include <cstddef>

namespace torquescope::kernels {

class PairwiseTree {
 public:
  // doubles needed to add up to n_terms vectors of n numbers
  static std::size_t workspace_size(std::size_t n_terms, std::size_t n) {
    return static_cast<std::size_t>(std::bit_width(n_terms)) * n;
  }

  // workspace: workspace_size(number of terms, n) doubles, not initialised
  PairwiseTree(std::size_t n, double* workspace) : n_(n), partial_(workspace) {}

  // overwrites term[0 .. n)
  void add(double* term) {
    std::size_t level = 0;
    // like a binary counter: two sums of 2^level terms carry over into one of 2^(level+1)
    for (; (count_ >> level & 1) != 0; ++level) add_left(level, term);
    for (std::size_t i = 0; i < n_; ++i) partial_[level * n_ + i] = term[i];
    ++count_;
  }

  // the sum of all terms, zero if there were none; n numbers
  void total(double* sum) const {
    for (std::size_t i = 0; i < n_; ++i) sum[i] = 0.0;
    bool empty = true;
    for (std::size_t level = 0; count_ >> level != 0; ++level) {
      if ((count_ >> level & 1) == 0) continue;
      if (empty) {
        for (std::size_t i = 0; i < n_; ++i) sum[i] = partial_[level * n_ + i];
      } else {
        add_left(level, sum);
      }
      empty = false;
    }
  }

 private:
  void add_left(std::size_t level, double* sum) const {
    for (std::size_t i = 0; i < n_; ++i) sum[i] = partial_[level * n_ + i] + sum[i];
  }

  std::size_t n_;
  double* partial_;        // [level][n]: the sum of 2^level neighbours that waits for its right neighbour
  std::size_t count_ = 0;  // terms so far; its bits say which levels are occupied
};

}  // namespace torquescope::kernels
