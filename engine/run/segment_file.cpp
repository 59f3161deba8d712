#include "engine/run/segment_file.hpp"

#include <algorithm>
#include <limits>

#include "engine/base/confined.hpp"
#include "engine/base/error.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {
namespace {

std::string parts_group(std::string const& label) { return "/parts/" + label + "/"; }

// the part that holds row `row` of the lists, and how far into it
struct Place {
  std::size_t part, generation;
};
std::vector<Place> places_of(std::vector<RunPart> const& parts) {
  std::vector<Place> places;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t generation = 0; generation < parts[i].count; ++generation) places.push_back({i, generation});
  return places;
}

// one list of all parts, generation after generation
void write_list(ResultWriter& writer, std::string const& group, HistoryList const& list,
                EstimatorParts const& estimator, std::vector<Place> const& places) {
  std::size_t const width = list.width(estimator.shape);
  if (width == 0) return;  // populations that are not kept
  h5::Shape shape{places.size()};
  if (width > 1) shape.push_back(width);
  writer.numbers_in_blocks(group + list.name, shape,
                           [&](std::size_t first, std::span<double> values) {
                             for (std::size_t i = 0; i * width < values.size(); ++i) {
                               auto const [part, generation] = places[first + i];
                               auto const& from = estimator.parts[part].history.*list.values;
                               std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(generation * width), width,
                                           values.begin() + static_cast<std::ptrdiff_t>(i * width));
                             }
                           },
                           {"1", list.name});
}

void write_whole(ResultWriter& writer, std::string const& path, std::vector<std::int64_t> const& values) {
  writer.whole_numbers(path, {values.size()}, values, {"1", path.substr(path.rfind('/') + 1)});
}

void write_states(ResultWriter& writer, std::string const& group, std::vector<RunPart> const& parts) {
  std::vector<std::string> names;
  std::vector<std::int64_t> entries, sizes;
  std::vector<double> numbers;
  for (auto const& part : parts) {
    entries.push_back(static_cast<std::int64_t>(part.state.size()));
    for (auto const& [name, values] : part.state) {
      names.push_back(name);
      sizes.push_back(static_cast<std::int64_t>(values.size()));
      numbers.insert(numbers.end(), values.begin(), values.end());
    }
  }
  write_whole(writer, group + "state_entries", entries);
  if (names.empty()) return;
  writer.texts(group + "state_names", names, {"1", "names of the numbers an optimiser goes on from"});
  write_whole(writer, group + "state_sizes", sizes);
  writer.numbers(group + "state_numbers", {numbers.size()}, numbers, {"1", "numbers an optimiser goes on from"});
}

void write_estimator(ResultWriter& writer, EstimatorParts const& estimator) {
  std::string const group = parts_group(estimator.label);
  std::string const itself = group.substr(0, group.size() - 1);
  auto const& shape = estimator.shape;
  writer.attribute(itself, "search_sha256", estimator.search_sha256);
  writer.attribute(itself, "runs", static_cast<std::int64_t>(shape.runs));
  writer.attribute(itself, "generations", static_cast<std::int64_t>(shape.generations));
  writer.attribute(itself, "members", static_cast<std::int64_t>(shape.members));
  writer.attribute(itself, "parameters", static_cast<std::int64_t>(shape.parameters));

  std::vector<std::int64_t> run, first, count, ended, nonfinite, evaluations;
  std::vector<double> elapsed_s, parameters;
  std::vector<std::string> stop_reason;
  for (auto const& part : estimator.parts) {
    run.push_back(static_cast<std::int64_t>(part.run));
    first.push_back(static_cast<std::int64_t>(part.first));
    count.push_back(static_cast<std::int64_t>(part.count));
    ended.push_back(part.ended ? 1 : 0);
    nonfinite.push_back(part.history.nonfinite);
    elapsed_s.push_back(part.history.elapsed_s);
    stop_reason.push_back(part.history.stop_reason);
    auto best = part.history.parameters;
    best.resize(shape.parameters, std::numeric_limits<double>::quiet_NaN());
    parameters.insert(parameters.end(), best.begin(), best.end());
    evaluations.insert(evaluations.end(), part.history.evaluations.begin(), part.history.evaluations.end());
  }
  write_whole(writer, group + "run", run);
  write_whole(writer, group + "first", first);
  write_whole(writer, group + "count", count);
  write_whole(writer, group + "ended", ended);
  write_whole(writer, group + "nonfinite", nonfinite);
  writer.numbers(group + "elapsed_s", {elapsed_s.size()}, elapsed_s, {"s", "spent on the run so far"});
  writer.texts(group + "stop_reason", stop_reason, {"1", "why the run ended"});
  writer.numbers(group + "parameters", {run.size(), shape.parameters}, parameters, {"SI", "of a run that has ended"});
  auto const places = places_of(estimator.parts);
  for (auto const& list : history_lists) write_list(writer, group, list, estimator, places);
  write_whole(writer, group + "evaluations", evaluations);
  write_states(writer, group, estimator.parts);
}

// of their lists: most of a segment
std::uintmax_t bytes_of(std::vector<EstimatorParts> const& estimators) {
  std::uintmax_t numbers = 0;
  for (auto const& estimator : estimators)
    for (auto const& part : estimator.parts)
      for (auto const& list : history_lists) numbers += (part.history.*list.values).size();
  return numbers * sizeof(double);
}

void write_origin(ResultWriter& writer, SegmentOrigin const& origin) {
  std::string const group = "/segment";
  writer.attribute(group, "job_sha256", origin.job_sha256);
  writer.attribute(group, "inputs_sha256", origin.inputs_sha256);
  writer.attribute(group, "numerics_sha256", origin.numerics_sha256);
  writer.attribute(group, "job_name", origin.job_name);
  writer.attribute(group, "shard_index", static_cast<std::int64_t>(origin.shard_index));
  writer.attribute(group, "shard_count", static_cast<std::int64_t>(origin.shard_count));
  writer.attribute(group, "host", origin.host);
  writer.attribute(group, "pid", origin.pid);
  writer.attribute(group, "threads", origin.threads);
  writer.attribute(group, "started", origin.started);
  writer.attribute(group, "written", origin.written);
}

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

void write_segment(FilePlace const& place, SegmentOrigin const& origin, std::vector<EstimatorParts> const& estimators) {
  ResultWriter writer(
      place, {.expected_bytes = bytes_of(estimators), .inputs_sha256 = origin.inputs_sha256, .keeps = Keeps::work});
  write_origin(writer, origin);
  std::vector<std::string> labels;
  for (auto const& estimator : estimators) {
    write_estimator(writer, estimator);
    labels.push_back(estimator.label);
  }
  writer.attribute("/parts", "order", labels);
  writer.finish();
}

SegmentFile::SegmentFile(FilePlace const& place) : reader_(place), origin_(read_origin(reader_)) {
  for (auto const& label : reader_.attribute<std::vector<std::string>>("/parts", "order")) read_index(label);
}

void SegmentFile::read_index(std::string const& label) {
  std::string const group = parts_group(label);
  auto const size = [&](char const* key) {
    auto const value = reader_.attribute<std::int64_t>(group.substr(0, group.size() - 1), key);
    if (value < 0) throw contradicts_itself(name(), group + key);
    return static_cast<std::size_t>(value);
  };
  Index index;
  index.search_sha256 = reader_.attribute<std::string>(group.substr(0, group.size() - 1), "search_sha256");
  index.shape = {size("runs"), size("generations"), size("members"), size("parameters")};
  std::size_t const n = reader_.whole_numbers(group + "run").values.size();
  auto const run = counts(reader_, group + "run", n), first = counts(reader_, group + "first", n),
             count = counts(reader_, group + "count", n), ended = counts(reader_, group + "ended", n),
             states = counts(reader_, group + "state_entries", n);
  auto const stop_reasons = reader_.texts(group + "stop_reason");
  if (stop_reasons.size() != n) throw contradicts_itself(name(), group + "stop_reason");
  std::size_t row = 0, state = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (run[i] >= index.shape.runs || first[i] + count[i] > index.shape.generations + 1)
      throw contradicts_itself(name(), group + "run");
    index.entries.push_back(
        {run[i], first[i], count[i], ended[i] == 1, row, state, state + states[i], stop_reasons[i]});
    row += count[i];
    state += states[i];
  }
  estimators_.emplace(label, std::move(index));
}

RunPart SegmentFile::read(std::string const& label, std::size_t entry) const {
  std::string const group = parts_group(label);
  Index const& index = estimators_.at(label);
  Entry const& wanted = index.entries.at(entry);
  RunPart part{.run = wanted.run, .first = wanted.first, .count = wanted.count, .ended = wanted.ended};
  // as many as there should be: rows may be of any width, none included
  auto const checked = [&](auto values, std::size_t expected, char const* what) {
    if (values.size() != expected) throw contradicts_itself(name(), group + what);
    return values;
  };
  auto const whole_rows = [&](char const* what, std::size_t first, std::size_t count) {
    return checked(reader_.whole_number_rows(group + what, first, count), count, what);
  };
  auto const number_rows = [&](char const* what, std::size_t first, std::size_t count, std::size_t width) {
    return checked(reader_.number_rows(group + what, first, count), count * width, what);
  };
  for (auto const& list : history_lists)
    if (std::size_t const width = list.width(index.shape); width > 0)
      part.history.*list.values = number_rows(list.name, wanted.row, wanted.count, width);
  part.history.evaluations = whole_rows("evaluations", wanted.row, wanted.count);
  part.history.nonfinite = whole_rows("nonfinite", entry, 1).front();
  part.history.elapsed_s = number_rows("elapsed_s", entry, 1, 1).front();
  if (wanted.ended) {
    part.history.stop_reason = wanted.stop_reason;
    part.history.parameters = number_rows("parameters", entry, 1, index.shape.parameters);
  }
  if (wanted.state_first == wanted.state_end) return part;
  auto const names = reader_.texts(group + "state_names");
  auto const sizes = counts(reader_, group + "state_sizes", names.size());
  if (wanted.state_end > names.size()) throw contradicts_itself(name(), group + "state_names");
  std::size_t at = 0;
  for (std::size_t i = 0; i < wanted.state_end; ++i) {
    if (i >= wanted.state_first) part.state[names[i]] = number_rows("state_numbers", at, sizes[i], 1);
    at += sizes[i];
  }
  return part;
}

void look_at_segment(FilePlace const& place, std::function<void(SegmentFile const&)> const& look) {
  auto const read = [&] {
    look(SegmentFile(place));
    return std::string();
  };
  run_confined(read, limits_for_file(place.path, 60), [&place](std::string const& how) {
    return Problem{.code = ExitCode::bad_data,
                   .what = place.path.string() + " is damaged: HDF5 " + how + " while reading it",
                   .help = "delete it and run the same command again"};
  });
}

std::vector<bool> harmless_segments(std::vector<FilePlace> const& places,
                                    std::function<void(SegmentFile const&)> const& look) {
  std::vector<bool> harmless(places.size(), false);
  if (places.empty()) return harmless;
  ConfinedLimits limits{.processor_seconds = 0};
  for (auto const& place : places) limits.processor_seconds += limits_for_file(place.path, 60).processor_seconds;
  auto const read = [&] {
    std::string answers(places.size(), 'n');
    for (std::size_t i = 0; i < places.size(); ++i) {
      try {
        look(SegmentFile(places[i]));
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
