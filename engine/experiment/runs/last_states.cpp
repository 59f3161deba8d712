#include "engine/experiment/runs/last_states.hpp"

#include <algorithm>
#include <cstdint>

#include "engine/base/contract.hpp"
#include "engine/experiment/stored_objects.hpp"

namespace torquescope {
namespace {

std::string group_of(std::string const& label) { return "/runs/" + label + "/last_state"; }

}  // namespace

void LastStates::add(OptimiserState const& state) {
  ++runs_;
  if (state.empty()) {
    sizes_.insert(sizes_.end(), names_.size(), 0);
    return;
  }
  if (runs_with_one_++ == 0) {
    for (auto const& [name, values] : state) names_.push_back(name);
    sizes_.assign((runs_ - 1) * names_.size(), 0);
  }
  TORQUESCOPE_EXPECT(state.size() == names_.size());
  for (auto const& [name, values] : state) {
    sizes_.push_back(static_cast<std::int64_t>(values.size()));
    numbers_.insert(numbers_.end(), values.begin(), values.end());
  }
}

void LastStates::write(ResultWriter& writer, std::string const& label) const {
  std::string const group = group_of(label);
  writer.attribute(group, "runs", static_cast<std::int64_t>(runs_with_one_));
  if (runs_with_one_ == 0) return;
  writer.texts(group + "/names", names_, {"1", "entries of the state that a longer search goes on from"});
  writer.whole_numbers(group + "/sizes", {runs_, names_.size()}, sizes_, {"1", "numbers of each entry"});
  writer.numbers(group + "/numbers", {numbers_.size()}, numbers_, {"1", "run after run, entry after entry"});
}

std::vector<OptimiserState> read_last_states(ResultReader const& reader, std::string const& label) {
  std::string const group = group_of(label);
  if (!reader.exists(group) || reader.attribute<std::int64_t>(group, "runs") == 0) return {};
  auto const names = reader.texts(group + "/names");
  auto const sizes = reader.whole_numbers(group + "/sizes");
  auto const numbers = reader.numbers(group + "/numbers").values;
  bool const is_table = sizes.shape.size() == 2 && sizes.shape[1] == names.size() && !names.empty();
  if (!is_table) throw contradiction(reader, group, "sizes are not of its entries");
  std::vector<OptimiserState> states(sizes.shape[0]);
  std::size_t at = 0;
  for (std::size_t i = 0; i < sizes.values.size(); ++i) {
    auto const left = static_cast<std::int64_t>(numbers.size() - at);
    std::int64_t const size = sizes.values[i];
    if (size < 0 || size > left) throw contradiction(reader, group, "sizes are more than its numbers");
    auto const from = numbers.begin() + static_cast<std::ptrdiff_t>(at);
    states[i / names.size()][names[i % names.size()]].assign(from, from + size);
    at += static_cast<std::size_t>(size);
  }
  // a run without a state: every state has entries that are not empty
  for (auto& state : states)
    if (std::all_of(state.begin(), state.end(), [](auto const& entry) { return entry.second.empty(); })) state.clear();
  return states;
}

}  // namespace torquescope
