#include "engine/experiment/runs/segment_pile.hpp"

#include <span>
#include <system_error>
#include <tuple>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/store/own_folder.hpp"

namespace torquescope {
namespace {

std::uintmax_t bytes_of_files(std::vector<std::filesystem::path> const& files) {
  std::uintmax_t bytes = 0;
  for (auto const& file : files) {
    std::error_code unknown;
    auto const size = std::filesystem::file_size(file, unknown);
    if (!unknown) bytes += size;
  }
  return bytes;
}

// one more part behind what is known of its run; false: it does not follow
bool join(RunPart& known, RunPart& next, HistoryShape const& shape) {
  if (known.ended || next.first != known.end()) return false;
  append(known.history, next, shape, next.first);
  known.count += next.count;
  known.ended = next.ended;
  known.state = std::move(next.state);
  known.history.stop_reason = std::move(next.history.stop_reason);
  known.history.parameters = std::move(next.history.parameters);
  return true;
}

bool are_of_one_writer(SegmentOrigin const& a, SegmentOrigin const& b) {
  auto const facts = [](SegmentOrigin const& o) {
    return std::tie(o.job_sha256, o.inputs_sha256, o.numerics_sha256, o.job_name, o.shard_index, o.shard_count, o.host,
                    o.pid, o.threads, o.started);
  };
  return facts(a) == facts(b);
}

// neighbours of one writer, as many as most_bytes allow
std::vector<std::span<LeftSegment const>> batches_of(std::span<LeftSegment const> left, std::uintmax_t most_bytes) {
  std::vector<std::span<LeftSegment const>> batches;
  std::uintmax_t bytes = 0;
  for (std::size_t i = 0, first = 0; i < left.size(); ++i) {
    std::uintmax_t const more = bytes_of_files({left[i].file});
    if (i == first || bytes + more > most_bytes || !are_of_one_writer(left[first].origin, left[i].origin)) {
      first = i;
      bytes = 0;
      batches.emplace_back();
    }
    bytes += more;
    batches.back() = left.subspan(first, i + 1 - first);
  }
  return batches;
}

// segments of a folder become one of it: read, written and removed in the very same
void gather(std::vector<std::filesystem::path> const& files, SegmentOrigin const& origin,
            std::filesystem::path const& gathered) {
  OwnFolder const folder(gathered.parent_path());
  std::vector<FilePlace> places;
  for (auto const& file : files) places.push_back(folder.place(file.filename().string()));
  write_segment(folder.place(gathered.filename().string()), origin, gathered_parts(places));
  for (auto const& place : places) folder.unlink(place.name);
}

}  // namespace

bool gather_left_segments(std::vector<LeftSegment> const& left, SegmentNames names, std::uintmax_t most_bytes) {
  bool any = false;
  try {
    for (auto const batch : batches_of(left, most_bytes)) {
      if (batch.size() < segments_together) continue;
      std::vector<std::filesystem::path> files;
      for (auto const& one : batch) files.push_back(one.file);
      gather(files, batch.back().origin, names.next());
      any = true;
    }
  } catch (Error const&) {  // they stay as they are
  }
  return any;
}

std::vector<EstimatorParts> gathered_parts(std::vector<FilePlace> const& segments) {
  std::vector<EstimatorParts> all;
  std::map<std::string, std::size_t> place_of_estimator;
  std::map<std::pair<std::string, std::size_t>, std::size_t> place_of_run;
  for (auto const& place : segments) {
    SegmentFile segment(place);
    for (auto const& [label, index] : segment.estimators()) {
      auto const [estimator, is_new] = place_of_estimator.emplace(label, all.size());
      if (is_new) all.push_back({label, index.search_sha256, index.shape, {}});
      auto& parts = all[estimator->second].parts;
      for (std::size_t i = 0; i < index.entries.size(); ++i) {
        RunPart part = segment.read(label, i);
        auto const [run, is_first] = place_of_run.emplace(std::pair(label, part.run), parts.size());
        if (!is_first && join(parts[run->second], part, index.shape)) continue;
        run->second = parts.size();
        parts.push_back(std::move(part));
      }
    }
  }
  return all;
}

void SegmentPile::add(std::filesystem::path const& segment, SegmentOrigin const& origin,
                      std::function<std::filesystem::path()> const& next_name) {
  std::filesystem::path newest = segment;
  try {
    for (std::size_t level = 0; gathers_; ++level) {
      if (level == levels_.size()) levels_.emplace_back();
      levels_[level].push_back(newest);
      if (levels_[level].size() < segments_together) return;
      auto const full = std::exchange(levels_[level], {});
      if (bytes_of_files(full) > most_bytes_) return;
      newest = next_name();
      gather(full, origin, newest);
    }
  } catch (Error const&) {
    gathers_ = false;
  }
}

}  // namespace torquescope
