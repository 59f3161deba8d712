#include "engine/experiment/runs/segment_facts.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/packed_bytes.hpp"

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

constexpr std::int64_t most_of_anything = std::int64_t{1} << 40;

// counts of a file are numbers like any others: none may lead outside
std::vector<std::size_t> counts(ResultReader const& reader, std::string const& path) {
  auto const read = reader.whole_numbers(path).values;
  auto const is_no_count = [](std::int64_t n) { return n < 0 || n > most_of_anything; };
  if (std::any_of(read.begin(), read.end(), is_no_count)) throw contradicts_itself(reader.name(), path);
  return {read.begin(), read.end()};
}

std::size_t size_of(ResultReader const& reader, std::string const& group, char const* key) {
  auto const value = reader.attribute<std::int64_t>(group.substr(0, group.size() - 1), key);
  if (value < 0) throw contradicts_itself(reader.name(), group + key);
  return static_cast<std::size_t>(value);
}

// an index as a segment stores it
struct IndexLists {
  std::string search_sha256;
  HistoryShape shape;
  std::vector<std::size_t> run, first, count, ended, state_entries;  // of every part
  std::vector<std::size_t> state_sizes;                              // of every entry of every state
  std::vector<std::string> stop_reason;
};

IndexLists read_index(ResultReader const& file, std::string const& label) {
  std::string const group = segment_group(label);
  IndexLists lists;
  lists.search_sha256 = file.attribute<std::string>(group.substr(0, group.size() - 1), "search_sha256");
  lists.shape = {size_of(file, group, "runs"), size_of(file, group, "generations"), size_of(file, group, "members"),
                 size_of(file, group, "parameters")};
  lists.run = counts(file, group + "run");
  lists.first = counts(file, group + "first");
  lists.count = counts(file, group + "count");
  lists.ended = counts(file, group + "ended");
  lists.state_entries = counts(file, group + "state_entries");
  bool const has_states = std::any_of(lists.state_entries.begin(), lists.state_entries.end(), [](auto n) { return n; });
  if (has_states) lists.state_sizes = counts(file, group + "state_sizes");
  lists.stop_reason = file.texts(group + "stop_reason");
  return lists;
}

SegmentIndex index_of(IndexLists lists, std::filesystem::path const& name, std::string const& label) {
  std::string const group = segment_group(label);
  std::size_t const n = lists.run.size();
  for (auto const& [list, key] : {std::pair{&lists.first, "first"}, std::pair{&lists.count, "count"},
                                  std::pair{&lists.ended, "ended"}, std::pair{&lists.state_entries, "state_entries"}})
    if (list->size() != n) throw contradicts_itself(name, group + key);
  if (lists.stop_reason.size() != n) throw contradicts_itself(name, group + "stop_reason");
  auto const& states = lists.state_entries;
  if (std::accumulate(states.begin(), states.end(), std::size_t{0}) != lists.state_sizes.size())
    throw contradicts_itself(name, group + "state_sizes");
  SegmentIndex index{std::move(lists.search_sha256), lists.shape, {}};
  index.entries.reserve(n);
  std::size_t row = 0, state = 0, number = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t const first = lists.first[i], count = lists.count[i];
    if (lists.run[i] >= index.shape.runs || first + count > index.shape.generations + 1)
      throw contradicts_itself(name, group + "run");
    index.entries.push_back({lists.run[i], first, count, lists.ended[i] == 1, row, state, state + states[i], number, 0,
                             std::move(lists.stop_reason[i])});
    row += count;
    for (std::size_t k = 0; k < states[i]; ++k) number += lists.state_sizes[state++];
    index.entries.back().state_numbers = number - index.entries.back().state_number;
  }
  return index;
}

}  // namespace

Error contradicts_itself(std::filesystem::path const& name, std::string const& what) {
  return Error(Problem{.code = ExitCode::bad_data,
                       .what = name.string() + " contradicts itself: " + what,
                       .help = "delete it and run the same command again"});
}

SegmentFacts facts_of(ResultReader const& segment) {
  SegmentFacts facts{segment.name(), segment.bytes(), read_origin(segment), {}};
  for (auto const& label : segment.attribute<std::vector<std::string>>("/parts", "order"))
    facts.estimators.emplace(label, index_of(read_index(segment, label), segment.name(), label));
  return facts;
}

std::string packed(SegmentFacts const& facts) {
  PackedWriter out;
  auto const whole = [&](std::size_t value) { out.whole(static_cast<std::int64_t>(value)); };
  auto const& o = facts.origin;
  whole(facts.bytes);
  out.texts({o.job_sha256, o.inputs_sha256, o.numerics_sha256, o.job_name, o.host, o.started, o.written});
  for (std::size_t const value : {o.shard_index, o.shard_count}) whole(value);
  out.whole(o.pid).whole(o.threads);
  whole(facts.estimators.size());
  for (auto const& [label, index] : facts.estimators) {
    out.text(label).text(index.search_sha256);
    auto const& shape = index.shape;
    for (std::size_t const value : {shape.runs, shape.generations, shape.members, shape.parameters}) whole(value);
    whole(index.entries.size());
    for (auto const& e : index.entries) {
      for (std::size_t const value : {e.run, e.first, e.count, std::size_t{e.ended}, e.row, e.state_first, e.state_end,
                                      e.state_number, e.state_numbers})
        whole(value);
      out.text(e.stop_reason);
    }
  }
  return out.take();
}

SegmentFacts unpacked_facts(std::filesystem::path const& name, std::string_view bytes) {
  PackedReader in(bytes);
  auto const whole = [&] { return static_cast<std::size_t>(in.whole()); };
  SegmentFacts facts;
  facts.name = name;
  facts.bytes = whole();
  auto& o = facts.origin;
  auto texts = in.texts();
  auto const of_origin = {&o.job_sha256, &o.inputs_sha256, &o.numerics_sha256, &o.job_name,
                          &o.host,       &o.started,       &o.written};
  if (texts.size() != of_origin.size()) throw std::out_of_range("facts of a segment end early");
  for (auto text = texts.begin(); auto* const into : of_origin) *into = std::move(*text++);
  o.shard_index = whole();
  o.shard_count = whole();
  o.pid = in.whole();
  o.threads = in.whole();
  for (std::size_t n = in.count(); n > 0; --n) {
    std::string const label = in.text();
    SegmentIndex index{in.text(), {}, {}};
    auto& shape = index.shape;
    for (auto* const into : {&shape.runs, &shape.generations, &shape.members, &shape.parameters}) *into = whole();
    for (std::size_t entries = in.count(); entries > 0; --entries) {
      SegmentEntry e{};
      e.run = whole(), e.first = whole(), e.count = whole(), e.ended = whole() == 1;
      for (auto* const into : {&e.row, &e.state_first, &e.state_end, &e.state_number, &e.state_numbers})
        *into = whole();
      e.stop_reason = in.text();
      // a run that ends where it was kept last leaves a part of no generation
      std::size_t const all = shape.generations + 1;
      if (e.run >= shape.runs || e.first > all || e.count > all - e.first)
        throw contradicts_itself(name, segment_group(label) + "run");
      index.entries.push_back(std::move(e));
    }
    facts.estimators.emplace(label, std::move(index));
  }
  return facts;
}

}  // namespace torquescope
