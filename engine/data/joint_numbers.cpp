#include "engine/data/joint_numbers.hpp"

#include <cstdlib>
#include <map>

namespace torquescope {
namespace {

// of columns that differ by their number alone: number -> place in the list
using Family = std::map<long, std::size_t>;

std::map<std::string, Family> families_of(std::vector<LikelyColumn> const& columns) {
  std::map<std::string, Family> families;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    auto const& number = columns[k].name.number;
    auto const at = number.empty() ? std::string::npos : columns[k].column.rfind(number);
    if (at == std::string::npos) continue;
    std::string stem = columns[k].column;
    stem.replace(at, number.size(), "#");
    families[stem][std::strtol(number.c_str(), nullptr, 10)] = k;
  }
  std::erase_if(families, [](auto const& one) {
    Family const& family = one.second;
    bool const has_gap = family.rbegin()->first - family.begin()->first + 1 != static_cast<long>(family.size());
    return family.size() < 2 || has_gap;
  });
  return families;
}

}  // namespace

std::optional<NumberShift> number_like(std::vector<LikelyColumn> const& positions, std::vector<LikelyColumn>& channel) {
  auto const measured = families_of(positions);
  std::optional<NumberShift> shift;
  for (auto const& [stem, family] : families_of(channel)) {
    long const first = family.begin()->first;
    Family const* neighbour = nullptr;
    bool has_own = false;
    for (auto const& [position_stem, position] : measured) {
      if (position.size() != family.size()) continue;
      long const away = position.begin()->first - first;
      has_own = has_own || away == 0;
      if (away == 1 || away == -1) neighbour = &position;
    }
    if (has_own || neighbour == nullptr) continue;
    long const away = neighbour->begin()->first - first;
    for (auto const& [number, k] : family) channel[k].name.number = std::to_string(number + away);
    if (!shift) shift = {positions[neighbour->begin()->second].column, channel[family.begin()->second].column};
  }
  return shift;
}

}  // namespace torquescope
