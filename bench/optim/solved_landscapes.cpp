// How many instances of each landscape an optimiser solves, the median of its evaluations when most are solved, and its
// expected running time: all evaluations over the number solved.
//
// Usage      bench_solved_landscapes <dimension> <instances> <optimiser> [first=instance] [key=word or number]...
// Budget     1e4 evaluations per parameter, target 1e-6, box -5 .. 5

#include <fmt/format.h>

#include <algorithm>

#include "support/landscapes.hpp"
#include "word_settings.hpp"

int main(int argc, char** argv) {
  using namespace torquescope;
  std::vector<std::string> const words(argv + 1, argv + argc);
  if (words.size() < 3) {
    fmt::print(stderr, "bench_solved_landscapes <dimension> <instances> <optimiser> [key=value]...\n");
    return 64;
  }
  auto const dimension = static_cast<std::size_t>(std::stoul(words[0]));
  auto const instances = static_cast<std::uint32_t>(std::stoul(words[1]));
  std::int64_t const most = 10000 * static_cast<std::int64_t>(dimension);
  std::vector<Setting> settings{{"evaluations", most}, {"generations", std::int64_t{0}}};
  std::uint32_t first = 0;
  for (std::size_t i = 3; i < words.size(); ++i) {
    if (words[i].starts_with("first=")) {
      first = static_cast<std::uint32_t>(std::stoul(words[i].substr(6)));
    } else {
      settings.push_back(bench::setting_of(words[i]));
    }
  }
  std::size_t total = 0;
  for (auto const& name : testing::landscape_names()) {
    std::vector<std::int64_t> spent;
    for (std::uint32_t run = first; run < first + instances; ++run) {
      auto const search = testing::make_optimiser(words[2], testing::cube(dimension, -5.0, 5.0), {46, run}, settings);
      spent.push_back(testing::evaluations_to_target(*search, testing::Landscape(name, dimension, run), 1e-6, most));
    }
    total += static_cast<std::size_t>(std::count_if(spent.begin(), spent.end(), [](auto n) { return n > 0; }));
    fmt::print("{:18} {}\n", name, bench::summary_of(spent, most));
  }
  fmt::print("{:18} {}/{}\n", "all", total, instances * testing::landscape_names().size());
}
