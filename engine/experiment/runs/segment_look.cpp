#include "engine/experiment/runs/segment_look.hpp"

#include <system_error>
#include <utility>

#include "engine/base/confined.hpp"
#include "engine/base/error.hpp"
#include "engine/base/packed_bytes.hpp"

namespace torquescope {
namespace {

// of files that a process looks at: so their indexes, however many runs there are, take little memory at a time
constexpr std::uintmax_t most_batch_bytes = std::uintmax_t{64} << 20;

std::size_t end_of_batch(std::vector<FilePlace> const& places, std::size_t first) {
  std::uintmax_t bytes = 0;
  std::size_t end = first;
  for (; end < places.size() && (end == first || bytes < most_batch_bytes); ++end) {
    std::error_code unknown;
    auto const size = std::filesystem::file_size(places[end].path, unknown);
    if (!unknown) bytes += size;
  }
  return end;
}

}  // namespace

SegmentLook::SegmentLook(std::vector<FilePlace> places, std::function<void(SegmentFile&)> look)
    : places_(std::move(places)), look_(std::move(look)) {}

SegmentFacts SegmentLook::facts(std::size_t i) {
  if (i >= first_ + batch_.size()) look_at_batch(i);
  auto& known = batch_[i - first_];
  return known ? *std::exchange(known, std::nullopt) : look_at_one(places_[i]);
}

void SegmentLook::look_at_batch(std::size_t first) {
  std::size_t const end = end_of_batch(places_, first);
  first_ = first;
  batch_.assign(end - first, std::nullopt);
  ConfinedLimits limits{.processor_seconds = 0};
  for (std::size_t i = first; i < end; ++i)
    limits.processor_seconds += limits_for_file(places_[i].path, 60).processor_seconds;
  auto const read = [&] {
    PackedWriter answers;
    for (std::size_t i = first; i < end; ++i) {
      try {
        SegmentFile file(places_[i]);
        look_(file);
        answers.text(packed(file.facts()));
      } catch (Error const&) {
        answers.text("");
      }
    }
    return answers.take();
  };
  try {
    std::string const bytes = run_confined(read, limits, [](std::string const& how) { return Problem{.what = how}; });
    PackedReader answers(bytes);
    for (std::size_t i = first; i < end; ++i)
      if (std::string const answer = answers.text(); !answer.empty())
        batch_[i - first] = unpacked_facts(places_[i].path, answer);
  } catch (Error const&) {  // one of them ended it
  } catch (std::out_of_range const&) {
  }
}

SegmentFacts SegmentLook::look_at_one(FilePlace const& place) const {
  auto const read = [&] {
    SegmentFile file(place);
    look_(file);
    return packed(file.facts());
  };
  auto const bytes = run_confined(read, limits_for_file(place.path, 60), [&place](std::string const& how) {
    return Problem{.code = ExitCode::bad_data,
                   .what = place.path.string() + " is damaged: HDF5 " + how + " while reading it",
                   .help = "delete it and run the same command again"};
  });
  try {
    return unpacked_facts(place.path, bytes);
  } catch (std::out_of_range const&) {
    throw contradicts_itself(place.path, "its index");
  }
}

}  // namespace torquescope
