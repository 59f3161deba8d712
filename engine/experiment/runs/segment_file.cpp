#include "engine/experiment/runs/segment_file.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "engine/base/error.hpp"

namespace torquescope {

SegmentFile::SegmentFile(FilePlace const& place, std::size_t ahead)
    : place_(place), ahead_(ahead), facts_(facts_of(reader())) {}

ResultReader const& SegmentFile::reader() {
  if (!reader_) reader_.emplace(place_);
  return *reader_;
}

// Of the bytes that are read ahead each dataset gets a part that grows with the root of its size: where these are fewer
// than a chunk, all of them together are read the fewest times
SegmentFile::Lists& SegmentFile::lists(std::string const& label) {
  if (lists_ && lists_->label == label) return *lists_;
  std::string const group = segment_group(label);
  std::map<std::string, h5::DatasetInfo> layouts;
  auto const root_of_size = [](h5::DatasetInfo const& layout) {
    return std::sqrt(static_cast<double>(layout.rows()) * static_cast<double>(layout.values_per_row()));
  };
  double roots = 0.0;
  for (auto const& dataset : reader().children(group.substr(0, group.size() - 1)))
    roots += root_of_size(layouts[dataset] = reader().layout(group + dataset));
  auto const ahead = [&]<class Value>(std::string const& dataset, std::type_identity<Value>) {
    auto const& layout = layouts[dataset];  // of one that is absent: none, which matters when it is asked for
    auto const bytes = static_cast<double>(ahead_) * root_of_size(layout) / std::max(1.0, roots);
    return RowsAhead<Value>(group + dataset, layout, static_cast<std::size_t>(bytes));
  };
  std::type_identity<double> const number;
  std::type_identity<std::int64_t> const whole;
  std::vector<RowsAhead<double>> histories;
  for (auto const& list : history_lists) histories.push_back(ahead(list.name, number));
  return lists_.emplace(Lists{.label = label,
                              .histories = std::move(histories),
                              .evaluations = ahead("evaluations", whole),
                              .nonfinite = ahead("nonfinite", whole),
                              .elapsed_s = ahead("elapsed_s", number),
                              .parameters = ahead("parameters", number),
                              .state_names = ahead("state_names", std::type_identity<std::string>{}),
                              .state_sizes = ahead("state_sizes", whole),
                              .state_numbers = ahead("state_numbers", number)});
}

// as many as there should be: rows may be of any width, none included
template <class Value>
std::span<Value const> SegmentFile::rows(RowsAhead<Value>& list, std::size_t first, std::size_t count,
                                         std::size_t width) {
  auto const found = list.rows([this]() -> ResultReader const& { return reader(); }, first, count);
  if (found.size() != count * width) throw contradicts_itself(name(), "lists of " + lists_->label);
  return found;
}

RunPart SegmentFile::read(std::string const& label, std::size_t entry) {
  SegmentIndex const& index = facts_.estimators.at(label);
  Lists& lists = this->lists(label);
  SegmentEntry const& wanted = index.entries.at(entry);
  RunPart part{.run = wanted.run, .first = wanted.first, .count = wanted.count, .ended = wanted.ended};
  auto const read = [&](auto& list, std::size_t first, std::size_t count, std::size_t width) {
    return rows(list, first, count, width);
  };
  auto const into = [](auto& to, auto from) { to.assign(from.begin(), from.end()); };
  for (std::size_t i = 0; i < history_lists.size(); ++i)
    if (std::size_t const width = history_lists[i].width(index.shape); width > 0)
      into(part.history.*history_lists[i].values, read(lists.histories[i], wanted.row, wanted.count, width));
  into(part.history.evaluations, read(lists.evaluations, wanted.row, wanted.count, 1));
  part.history.nonfinite = read(lists.nonfinite, entry, 1, 1).front();
  part.history.elapsed_s = read(lists.elapsed_s, entry, 1, 1).front();
  if (wanted.ended) {
    part.history.stop_reason = wanted.stop_reason;
    into(part.history.parameters, read(lists.parameters, entry, 1, index.shape.parameters));
  }
  part.state = read_state(lists, wanted);
  return part;
}

StoredRuns SegmentFile::read_runs(std::string const& label, std::size_t first_entry, std::size_t count) {
  SegmentIndex const& index = facts_.estimators.at(label);
  Lists& lists = this->lists(label);
  std::size_t const row = index.entries.at(first_entry).row, n_rows = count * (index.shape.generations + 1);
  auto const read = [&](auto& list, std::size_t first, std::size_t n, std::size_t width, auto& into) {
    into.values = rows(list, first, n, width);
    into.owner = list.owner();
  };
  StoredRuns runs{.count = count};
  for (std::size_t i = 0; i < history_lists.size(); ++i)
    if (std::size_t const width = history_lists[i].width(index.shape); width > 0)
      read(lists.histories[i], row, n_rows, width, runs.histories[i]);
  read(lists.evaluations, row, n_rows, 1, runs.evaluations);
  read(lists.nonfinite, first_entry, count, 1, runs.nonfinite);
  read(lists.parameters, first_entry, count, index.shape.parameters, runs.parameters);
  for (std::size_t i = 0; i < count; ++i) {
    SegmentEntry const& entry = index.entries.at(first_entry + i);
    runs.stop_reasons.push_back(entry.stop_reason);
    runs.last_states.push_back(read_state(lists, entry));
  }
  return runs;
}

OptimiserState SegmentFile::read_state(Lists& lists, SegmentEntry const& entry) {
  OptimiserState state;
  std::size_t const n = entry.state_end - entry.state_first;
  if (n == 0) return state;
  auto const open = [this]() -> ResultReader const& { return reader(); };
  auto const names = lists.state_names.rows(open, entry.state_first, n);
  auto const sizes = lists.state_sizes.rows(open, entry.state_first, n);
  auto numbers = lists.state_numbers.rows(open, entry.state_number, entry.state_numbers);
  if (names.size() != n || sizes.size() != n || numbers.size() != entry.state_numbers)
    throw contradicts_itself(name(), "states of " + lists.label);
  for (std::size_t i = 0; i < n; ++i) {
    auto const size = static_cast<std::size_t>(sizes[i]);
    if (size > numbers.size()) throw contradicts_itself(name(), "states of " + lists.label);
    state[names[i]].assign(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(size));
    numbers = numbers.subspan(size);
  }
  return state;
}

}  // namespace torquescope
