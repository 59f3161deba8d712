#include "engine/experiment/runs/segment_file.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>

#include "engine/base/confined.hpp"
#include "engine/base/error.hpp"

namespace torquescope {
namespace {

SegmentOrigin read_origin(ResultReader const& reader) {
  auto const text = [&](char const* name) { return reader.attribute<std::string>("/segment", name); };
  auto const whole = [&](char const* name) { return reader.attribute<std::int64_t>("/segment", name); };
  SegmentOrigin origin;
  origin.job_sha256 = text("job_sha256");
  origin.inputs_sha256 = text("inputs_sha256");
  origin.numerics_sha256 = text("numerics_sha256");
  origin.job_name = text("job_name");
  origin.shard_index = static_cast<std::size_t>(whole("shard_index"));
  origin.shard_count = static_cast<std::size_t>(whole("shard_count"));
  origin.host = text("host");
  origin.pid = whole("pid");
  origin.threads = whole("threads");
  origin.started = text("started");
  origin.written = text("written");
  return origin;
}

Error contradicts_itself(std::filesystem::path const& name, std::string const& what) {
  return Error(Problem{.code = ExitCode::bad_data,
                       .what = name.string() + " contradicts itself: " + what,
                       .help = "delete it and run the same command again"});
}

constexpr std::int64_t most_of_anything = std::int64_t{1} << 40;

// counts of a file are numbers like any others: none may lead outside
std::vector<std::size_t> counts(ResultReader const& reader, std::string const& path, std::size_t expected) {
  auto const read = reader.whole_numbers(path).values;
  auto const is_no_count = [](std::int64_t n) { return n < 0 || n > most_of_anything; };
  if (read.size() != expected || std::any_of(read.begin(), read.end(), is_no_count))
    throw contradicts_itself(reader.name(), path);
  return {read.begin(), read.end()};
}

}  // namespace

SegmentFile::SegmentFile(FilePlace const& place, std::size_t ahead) : place_(place), ahead_(ahead) {
  bytes_ = reader().bytes();
  origin_ = read_origin(reader());
  for (auto const& label : reader().attribute<std::vector<std::string>>("/parts", "order")) read_index(label);
}

ResultReader const& SegmentFile::reader() {
  if (!reader_) reader_.emplace(place_);
  return *reader_;
}

void SegmentFile::read_index(std::string const& label) {
  std::string const group = segment_group(label);
  auto const& file = reader();
  auto const size = [&](char const* key) {
    auto const value = file.attribute<std::int64_t>(group.substr(0, group.size() - 1), key);
    if (value < 0) throw contradicts_itself(name(), group + key);
    return static_cast<std::size_t>(value);
  };
  Index index;
  index.search_sha256 = file.attribute<std::string>(group.substr(0, group.size() - 1), "search_sha256");
  index.shape = {size("runs"), size("generations"), size("members"), size("parameters")};
  std::size_t const n = file.whole_numbers(group + "run").values.size();
  auto const run = counts(file, group + "run", n), first = counts(file, group + "first", n),
             count = counts(file, group + "count", n), ended = counts(file, group + "ended", n),
             states = counts(file, group + "state_entries", n);
  std::size_t const n_states = std::accumulate(states.begin(), states.end(), std::size_t{0});
  auto const state_sizes = n_states > 0 ? counts(file, group + "state_sizes", n_states) : std::vector<std::size_t>();
  auto const stop_reasons = file.texts(group + "stop_reason");
  if (stop_reasons.size() != n) throw contradicts_itself(name(), group + "stop_reason");
  std::size_t row = 0, state = 0, number = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (run[i] >= index.shape.runs || first[i] + count[i] > index.shape.generations + 1)
      throw contradicts_itself(name(), group + "run");
    index.entries.push_back(
        {run[i], first[i], count[i], ended[i] == 1, row, state, state + states[i], number, 0, stop_reasons[i]});
    row += count[i];
    for (std::size_t k = 0; k < states[i]; ++k) number += state_sizes[state++];
    index.entries.back().state_numbers = number - index.entries.back().state_number;
  }
  estimators_.emplace(label, std::move(index));
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
  Index const& index = estimators_.at(label);
  Lists& lists = this->lists(label);
  Entry const& wanted = index.entries.at(entry);
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
  Index const& index = estimators_.at(label);
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
    Entry const& entry = index.entries.at(first_entry + i);
    runs.stop_reasons.push_back(entry.stop_reason);
    runs.last_states.push_back(read_state(lists, entry));
  }
  return runs;
}

OptimiserState SegmentFile::read_state(Lists& lists, Entry const& entry) {
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

void look_at_segment(FilePlace const& place, std::function<void(SegmentFile&)> const& look) {
  auto const read = [&] {
    SegmentFile file(place);
    look(file);
    return std::string();
  };
  run_confined(read, limits_for_file(place.path, 60), [&place](std::string const& how) {
    return Problem{.code = ExitCode::bad_data,
                   .what = place.path.string() + " is damaged: HDF5 " + how + " while reading it",
                   .help = "delete it and run the same command again"};
  });
}

std::vector<bool> harmless_segments(std::vector<FilePlace> const& places,
                                    std::function<void(SegmentFile&)> const& look) {
  std::vector<bool> harmless(places.size(), false);
  if (places.empty()) return harmless;
  ConfinedLimits limits{.processor_seconds = 0};
  for (auto const& place : places) limits.processor_seconds += limits_for_file(place.path, 60).processor_seconds;
  auto const read = [&] {
    std::string answers(places.size(), 'n');
    for (std::size_t i = 0; i < places.size(); ++i) {
      try {
        SegmentFile file(places[i]);
        look(file);
        answers[i] = 'y';
      } catch (Error const&) {
      }
    }
    return answers;
  };
  try {
    std::string const answers = run_confined(read, limits, [](std::string const& how) { return Problem{.what = how}; });
    for (std::size_t i = 0; i < places.size(); ++i) harmless[i] = answers[i] == 'y';
  } catch (Error const&) {  // one of them ended it
  }
  return harmless;
}

}  // namespace torquescope
