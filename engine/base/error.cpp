#include "engine/base/error.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {

Error::Error(Problem problem) : std::runtime_error(problem.what), problems_{std::move(problem)} {}

Error::Error(std::vector<Problem> problems) : std::runtime_error(problems.at(0).what), problems_(std::move(problems)) {}

namespace {

// Damerau-Levenshtein distance (optimal string alignment): a swap of neighbours counts once
std::size_t edit_distance(std::string const& a, std::string const& b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      std::size_t const substitute = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, substitute});
      bool const swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) current[j] = std::min(current[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = current;
  }
  return last[b.size()];
}

}  // namespace

std::string closest_name(std::string const& word, std::vector<std::string> const& candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (auto const& candidate : candidates) {
    std::size_t const distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace torquescope
