#include "engine/experiment/runs/saved_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/experiment/runs/segment_look.hpp"
#include "engine/store/own_folder.hpp"

namespace torquescope {
namespace {

// descriptors: systems allow 1024 by default
constexpr std::size_t most_open_files = 200;
constexpr std::size_t fewest_kept = 16;
// a segment that ends so many runs before the one that is asked for is done with: threads are never that far apart
constexpr std::size_t runs_under_way = 1000;
// of all segments that are kept. 64 KiB are some small runs: less would read each chunk too often
constexpr std::size_t most_bytes_ahead = std::size_t{256} << 20, least_bytes_ahead = std::size_t{64} << 10;
constexpr int most_listings = 10;

// the number of runs may grow
bool same_lists(HistoryShape const& a, HistoryShape const& b) {
  return a.generations == b.generations && a.members == b.members && a.parameters == b.parameters;
}

Error other_job(SegmentFacts const& file, SegmentOrigin const& expected) {
  bool const other_text = file.origin.job_sha256 != expected.job_sha256;
  std::string const folder = file.name.parent_path().string();
  Problem problem;
  problem.code = ExitCode::bad_job;
  problem.what =
      fmt::format("{} holds runs of {}", file.name.string(),
                  other_text ? fmt::format("another job, \"{}\" (the sha256 of its text differs)", file.origin.job_name)
                             : "this job on other recordings (their sha256 differs)");
  problem.help = fmt::format(
      "--out another name, or delete {}; --allow-mixed goes on with those estimators whose numbers stay the same",
      folder);
  return Error(problem);
}

Error other_program(SegmentFacts const& file) {
  Problem problem;
  problem.code = ExitCode::bad_job;
  problem.what =
      fmt::format("{} was written by another program (sources, compiler or build differ)", file.name.string());
  problem.notes = {"its runs may differ in their last digits from those of this one"};
  problem.help = fmt::format("go on with the program that began; or delete {} and begin again; or --allow-mixed",
                             file.name.parent_path().string());
  return Error(problem);
}

Error other_search(std::filesystem::path const& name, std::string const& label) {
  return Error(Problem{
      .code = ExitCode::bad_job,
      .what = fmt::format("runs of {} in {} were made with other settings, or on other data", label, name.string()),
      .notes = {"--allow-mixed takes what follows from the same numbers, and this does not"},
      .help = "--out another name, or delete " + name.parent_path().string()});
}

Error disagree(std::string const& label, std::size_t run, std::size_t generation, std::filesystem::path const& one,
               std::filesystem::path const& other) {
  Problem problem;
  problem.code = ExitCode::bad_data;
  problem.what = fmt::format("two segments disagree about generation {} of run {} of {}", generation, run, label);
  problem.notes = {one.string(), other.string(),
                   "equal jobs give equal bits: a machine or this program is at fault, or a file was changed"};
  problem.help = "delete the one whose machine you trust less, and run the same command again";
  return Error(problem);
}

}  // namespace

SavedRuns::SavedRuns(SavedRunsRequest const& request) : request_(request) { read_all(); }

void SavedRuns::read_all() {
  for (int listing = 1;; ++listing) {
    files_.clear();
    open_.clear();
    pieces_.clear();
    origins_.clear();
    warnings_.clear();
    mixed_ = false;
    folders_ = {std::make_shared<OwnFolder const>(request_.own_folder)};
    for (auto const& folder : request_.more_folders) folders_.push_back(std::make_shared<OpenFolder const>(folder));
    bool is_whole = true;
    for (auto const& folder : folders_) is_whole = read_folder(*folder) && is_whole;
    if (is_whole || listing == most_listings) break;
  }
  n_shards_ = shards();
  for (auto& [label, pieces] : pieces_)
    std::sort(pieces.begin(), pieces.end(), [](Piece const& a, Piece const& b) {
      return std::tie(a.run, a.first, b.end, a.file, a.entry) < std::tie(b.run, b.first, a.end, b.file, b.entry);
    });
}

// false: a segment that was listed is gone
bool SavedRuns::read_folder(OpenFolder const& folder) {
  SegmentLook look(segments_in(folder), [&](SegmentFile& file) {
    if (accept(file.facts(), request_)) file.verify();
  });
  bool is_whole = true;
  for (std::size_t i = 0; i < look.places().size(); ++i) {
    try {
      SegmentFacts const facts = look.facts(i);
      if (!accept(facts, request_)) continue;
      files_.push_back(look.places()[i]);
      take(facts, files_.size() - 1);
    } catch (Error const& error) {
      // removed meanwhile, or damaged: as if it had never been there
      if (error.code() != ExitCode::bad_data && error.code() != ExitCode::no_input) throw;
      is_whole = is_whole && error.code() != ExitCode::no_input;
      warnings_.push_back(error.problems().front().what + "; its generations run again");
    }
  }
  return is_whole;
}

// false: nothing in it is wanted
bool SavedRuns::accept(SegmentFacts const& file, SavedRunsRequest const& request) {
  bool const same_inputs = file.origin.inputs_sha256 == request.expected.inputs_sha256;
  bool const same_program = file.origin.numerics_sha256 == request.expected.numerics_sha256;
  if (!same_inputs && !request.allow_mixed) throw other_job(file, request.expected);
  if (!same_program && !request.allow_mixed) throw other_program(file);
  bool wanted = false;
  for (auto const& [label, index] : file.estimators) {
    auto const known = request.searches.find(label);
    if (known == request.searches.end()) continue;
    if (known->second != index.search_sha256) throw other_search(file.name, label);
    wanted = wanted || !request.wanted ||
             std::any_of(index.entries.begin(), index.entries.end(),
                         [&](auto const& entry) { return request.wanted(entry.run); });
  }
  if (wanted) mixed_ = mixed_ || !same_program || !same_inputs;
  return wanted;
}

void SavedRuns::take(SegmentFacts const& file, std::size_t index) {
  origins_.push_back(file.origin);
  for (auto const& [label, estimator] : file.estimators)
    for (std::size_t i = 0; i < estimator.entries.size(); ++i) {
      auto const& entry = estimator.entries[i];
      pieces_[label].push_back({entry.run, static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(i),
                                static_cast<std::uint32_t>(entry.first),
                                static_cast<std::uint32_t>(entry.first + entry.count), entry.ended});
    }
}

SavedRuns::PiecesOfRun SavedRuns::find(std::string const& label, std::size_t run) const {
  auto const known = pieces_.find(label);
  if (known == pieces_.end()) return {};
  auto const first = std::lower_bound(known->second.begin(), known->second.end(), run,
                                      [](Piece const& piece, std::size_t wanted) { return piece.run < wanted; });
  auto last = first;
  while (last != known->second.end() && last->run == run) ++last;
  return {first, last};
}

std::size_t SavedRuns::generations(std::string const& label, std::size_t run) const {
  std::size_t end = 0;
  for (auto const& piece : find(label, run))
    if (piece.first <= end) end = std::max<std::size_t>(end, piece.end);
  return end;
}

bool SavedRuns::has_ended(std::string const& label, std::size_t run) const {
  auto const pieces = find(label, run);
  std::size_t const end = generations(label, run);
  return std::any_of(pieces.begin(), pieces.end(), [&](Piece const& p) { return p.ended && p.end <= end; });
}

std::size_t SavedRuns::shards() const {
  std::set<std::pair<std::size_t, std::size_t>> shards;
  for (auto const& origin : origins_) shards.emplace(origin.shard_index, origin.shard_count);
  return shards.size();
}

// Neighbouring runs are of different shards, so one segment of each stays; those asked for longest ago are done with
SegmentFile& SavedRuns::opened(Piece const& piece) {
  std::size_t const file = piece.file;
  auto known = open_.find(file);
  if (known == open_.end()) {
    std::erase_if(open_, [&](auto const& one) { return one.second.last_run + runs_under_way < piece.run; });
    if (open_.size() >= std::max(fewest_kept, n_shards_))
      open_.erase(std::min_element(open_.begin(), open_.end(),
                                   [](auto const& a, auto const& b) { return a.second.asked < b.second.asked; }));
    std::size_t const ahead =
        std::clamp(most_bytes_ahead / std::max(fewest_kept, n_shards_), least_bytes_ahead, SegmentFile::most_ahead);
    auto segment = std::make_unique<SegmentFile>(files_[file], ahead);
    std::size_t last_run = 0;
    for (auto const& [label, index] : segment->estimators())
      for (auto const& entry : index.entries) last_run = std::max(last_run, entry.run);
    known = open_.emplace(file, Opened{std::move(segment), 0, last_run}).first;
  }
  known->second.asked = ++n_asked_;
  return *known->second.file;
}

template <class Load>
auto SavedRuns::listing_again(Load&& load) -> decltype(load()) {
  for (int listing = 1;; ++listing) {
    try {
      return load();
    } catch (Error const& error) {
      if (error.code() != ExitCode::no_input || listing == most_listings) throw;
    }
    read_all();
  }
}

std::optional<RunPart> SavedRuns::load(std::string const& label, HistoryShape const& shape, std::size_t run) {
  return listing_again([&] { return load_now(label, shape, run); });
}

std::optional<StoredRuns> SavedRuns::load_stored(std::string const& label, HistoryShape const& shape, std::size_t run,
                                                 std::size_t most) {
  return listing_again([&] { return load_stored_now(label, shape, run, most); });
}

std::optional<StoredRuns> SavedRuns::load_stored_now(std::string const& label, HistoryShape const& shape,
                                                     std::size_t run, std::size_t most) {
  auto const is_whole = [&](Piece const& piece) {
    return piece.ended && piece.first == 0 && piece.end == shape.generations + 1;
  };
  auto const pieces = find(label, run);
  if (pieces.size() != 1 || !is_whole(pieces.front())) return std::nullopt;
  Piece const first = pieces.front();
  std::size_t count = 1;
  for (; count < most; ++count) {
    auto const next = find(label, run + count);
    if (next.size() != 1 || !is_whole(next.front())) break;
    if (next.front().file != first.file || next.front().entry != first.entry + count) break;
  }
  SegmentFile& file = opened(first);
  if (!same_lists(file.estimators().at(label).shape, shape)) throw other_search(file.name(), label);
  StoredRuns runs = file.read_runs(label, first.entry, count);
  if (n_shards_ > most_open_files) file.close();
  return runs;
}

std::optional<RunPart> SavedRuns::load_now(std::string const& label, HistoryShape const& shape, std::size_t run) {
  auto const pieces = find(label, run);
  if (pieces.empty()) return std::nullopt;
  RunPart whole{.run = run};
  std::vector<std::pair<std::size_t, std::size_t>> sources;  // until which generation, from which file
  auto const source_of = [&](std::size_t generation) {
    for (auto const& [end, file] : sources)
      if (generation < end) return files_[file].path;
    return files_[sources.back().second].path;
  };
  for (Piece const& piece : pieces) {
    if (piece.first > whole.count) break;  // what lies between is lost: so is what follows
    SegmentFile& file = opened(piece);
    if (!same_lists(file.estimators().at(label).shape, shape)) throw other_search(file.name(), label);
    RunPart part = file.read(label, piece.entry);
    if (n_shards_ > most_open_files) file.close();
    std::size_t const difference = first_difference(whole.history, part, shape);
    if (difference < part.end()) throw disagree(label, run, difference, source_of(difference), file.name());
    // an end is an end: nothing comes behind it, and two ends are one
    bool const both_end = whole.ended && part.ended;
    bool const goes_on = (whole.ended && part.end() > whole.count) || (part.ended && part.end() < whole.count);
    if (goes_on || (both_end && (part.end() != whole.count || part.history.stop_reason != whole.history.stop_reason)))
      throw disagree(label, run, std::min(part.end(), whole.count), source_of(whole.count), file.name());
    if (part.end() > whole.count) {
      std::size_t const from = whole.count;
      append(whole.history, part, shape, from);
      whole.count = part.end();
      whole.state = part.state;
      sources.emplace_back(whole.count, piece.file);
    }
    if (part.ended) {
      whole.ended = true;
      whole.history.stop_reason = part.history.stop_reason;
      whole.history.parameters = part.history.parameters;
      whole.history.last_state = std::move(part.state);
    }
  }
  if (whole.count == 0) return std::nullopt;
  if (whole.ended) {
    whole.history.told = whole.count;
    whole.history.pad(shape.generations + 1, shape.members, shape.parameters);
  }
  return whole;
}

}  // namespace torquescope
