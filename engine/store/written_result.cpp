#include "engine/store/written_result.hpp"

#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "engine/base/error.hpp"

namespace torquescope {
namespace {

constexpr std::size_t most_bytes_of_array = std::size_t{64} << 10, most_bytes = std::size_t{1} << 20;

Error lacks(std::filesystem::path const& name, std::string const& what) {
  return Error(Problem{.code = ExitCode::bad_data, .what = fmt::format("{} has no {}", name.string(), what)});
}

}  // namespace

void WrittenResult::keep_object(std::string const& path, h5::Shape const& shape) {
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
    objects_.try_emplace(path.substr(0, slash));
  objects_[path].shape = shape;
}

void WrittenResult::keep_attribute(std::string const& path, std::string const& name, OptionValue value) {
  objects_.at(path).attributes.insert_or_assign(name, std::move(value));
}

bool WrittenResult::has_room(std::size_t bytes) {
  if (bytes > most_bytes_of_array || kept_bytes_ + bytes > most_bytes) return false;
  kept_bytes_ += bytes;
  return true;
}

void WrittenResult::keep_numbers(std::string const& path, std::span<double const> values) {
  if (has_room(values.size_bytes())) objects_.at(path).numbers.emplace(values.begin(), values.end());
}

void WrittenResult::keep_texts(std::string const& path, std::vector<std::string> texts) {
  auto const add = [](std::size_t sum, std::string const& text) { return sum + sizeof(std::string) + text.size(); };
  if (has_room(std::accumulate(texts.begin(), texts.end(), std::size_t{0}, add)))
    objects_.at(path).texts = std::move(texts);
}

WrittenResult::Object const& WrittenResult::object(std::string const& path) const {
  auto const found = objects_.find(path);
  if (found == objects_.end()) throw lacks(name_, path);
  return found->second;
}

h5::Shape WrittenResult::shape(std::string const& path) const { return object(path).shape; }

ResultReader::Numbers WrittenResult::numbers(std::string const& path) const {
  Object const& found = object(path);
  return found.numbers ? ResultReader::Numbers{found.shape, *found.numbers} : ResultReader(name_).numbers(path);
}

std::vector<std::string> WrittenResult::texts(std::string const& path) const {
  Object const& found = object(path);
  return found.texts ? *found.texts : ResultReader(name_).texts(path);
}

// nothing when there is none, or it is of another type
std::optional<OptionValue> WrittenResult::find_value(std::string const& path, std::string const& name,
                                                     OptionValue const& wanted) const {
  auto const& attributes = object(path).attributes;
  auto const found = attributes.find(name);
  return found == attributes.end() ? std::nullopt : converted(found->second, wanted);
}

OptionValue WrittenResult::value(std::string const& path, std::string const& name, OptionValue const& wanted) const {
  auto found = find_value(path, name, wanted);
  if (!found) throw lacks(name_, fmt::format("attribute \"{}\" in {}", name, path));
  return *std::move(found);
}

}  // namespace torquescope
