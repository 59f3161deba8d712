// How a segment is written: the other half of segment_file.cpp.

#include <algorithm>
#include <limits>
#include <span>

#include "engine/experiment/runs/segment_file.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {
namespace {

RunHistory const& history_of(RunPart const& part) { return part.whole ? *part.whole : part.history; }
// where the part's generations begin in it
std::size_t begin_of(RunPart const& part) { return part.whole ? part.first : 0; }

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
                               RunPart const& of = estimator.parts[part];
                               double const* const from = (history_of(of).*list.values).data();
                               std::copy_n(from + (begin_of(of) + generation) * width, width, &values[i * width]);
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
  std::string const group = segment_group(estimator.label);
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
    RunHistory const& history = history_of(part);
    run.push_back(static_cast<std::int64_t>(part.run));
    first.push_back(static_cast<std::int64_t>(part.first));
    count.push_back(static_cast<std::int64_t>(part.count));
    ended.push_back(part.ended ? 1 : 0);
    nonfinite.push_back(history.nonfinite);
    elapsed_s.push_back(history.elapsed_s);
    stop_reason.push_back(history.stop_reason);
    auto best = history.parameters;
    best.resize(shape.parameters, std::numeric_limits<double>::quiet_NaN());
    parameters.insert(parameters.end(), best.begin(), best.end());
    auto const of_part = std::span(history.evaluations).subspan(begin_of(part), part.count);
    evaluations.insert(evaluations.end(), of_part.begin(), of_part.end());
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
      for (auto const& list : history_lists) numbers += part.count * list.width(estimator.shape);
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

}  // namespace torquescope
