// How many instances of each landscape an optimiser solves, and the median of its evaluations when most are solved.
//
// Usage      bench_solved_landscapes <dimension> <instances> <optimiser> [first=instance] [key=word or number]...
// Budget     1e4 evaluations per parameter, target 1e-6, box -5 .. 5

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "support/landscapes.hpp"

namespace {

using namespace torquescope;

template <class Number>
bool reads_as(std::string const& text, Number& number) {
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

Setting setting_of(std::string const& word) {
  auto const split = word.find('=');
  std::string const value = split == std::string::npos ? "" : word.substr(split + 1);
  std::string const key = word.substr(0, split);
  std::int64_t whole = 0;
  double real = 0.0;
  if (reads_as(value, whole)) return {key, whole};
  if (reads_as(value, real)) return {key, real};
  return {key, value};
}

}  // namespace

int main(int argc, char** argv) {
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
      settings.push_back(setting_of(words[i]));
    }
  }
  std::size_t total = 0;
  for (auto const& name : testing::landscape_names()) {
    if (auto const* o = std::getenv("ONLY"); o && std::string(o).find("," + name + ",") == std::string::npos) continue;
    std::vector<std::int64_t> needed;
    std::int64_t all_spent = 0;
    for (std::uint32_t run = first; run < first + instances; ++run) {
      auto const search = testing::make_optimiser(words[2], testing::cube(dimension, -5.0, 5.0), {46, run}, settings);
      auto const spent = testing::evaluations_to_target(*search, testing::Landscape(name, dimension, run), 1e-6, most);
      if (spent > 0) needed.push_back(spent);
      all_spent += spent > 0 ? spent : most;
    }
    std::sort(needed.begin(), needed.end());
    total += needed.size();
    bool const has_median = 2 * needed.size() > instances;
    fmt::print("{:18} {:2}/{} {:>8} {:>8}\n", name, needed.size(), instances,
               has_median ? fmt::format("{}", needed[instances / 2]) : "-",
               needed.empty() ? "-" : fmt::format("{}", all_spent / static_cast<std::int64_t>(needed.size())));
  }
  fmt::print("{:18} {}/{}\n", "all", total, instances * testing::landscape_names().size());
}
