#include "engine/run/segment_pile.hpp"

#include <system_error>
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

}  // namespace

std::vector<EstimatorParts> gathered_parts(std::vector<std::filesystem::path> const& segments) {
  std::vector<EstimatorParts> all;
  std::map<std::string, std::size_t> place_of_estimator;
  std::map<std::pair<std::string, std::size_t>, std::size_t> place_of_run;
  for (auto const& name : segments) {
    SegmentFile const segment(name);
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
      if (levels_[level].size() < together) return;
      auto const full = std::exchange(levels_[level], {});
      if (bytes_of_files(full) > most_bytes_) return;
      newest = next_name();
      OwnFolder const folder(newest.parent_path());
      write_segment(folder.place(newest.filename().string()), origin, gathered_parts(full));
      for (auto const& file : full) folder.unlink(file.filename().string());
    }
  } catch (Error const&) {
    gathers_ = false;
  }
}

}  // namespace torquescope
