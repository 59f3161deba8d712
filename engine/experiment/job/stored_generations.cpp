#include "engine/experiment/job/stored_generations.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace torquescope {
namespace {

constexpr std::string_view every = "every ";

// a whole number from 1 on and nothing else; nothing where it is none
std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t number = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number == 0) return std::nullopt;
  return number;
}

std::optional<std::size_t> step_of(std::string_view word) {
  if (word == "full") return 1;
  if (word == "last") return 0;
  if (word.substr(0, every.size()) != every) return std::nullopt;
  return whole_number(word.substr(every.size()));
}

}  // namespace

std::optional<StoredGenerations> StoredGenerations::of(std::string const& word, std::size_t generations) {
  auto const step = step_of(word);
  if (!step) return std::nullopt;
  return StoredGenerations(*step, generations);
}

std::size_t StoredGenerations::count() const {
  if (step_ == 0) return 1;
  return generations_ / step_ + 1 + (generations_ % step_ == 0 ? 0 : 1);
}

std::size_t StoredGenerations::number(std::size_t entry) const {
  return entry + 1 == count() ? generations_ : entry * step_;
}

std::optional<std::size_t> StoredGenerations::in_run(std::size_t entry, std::size_t told) const {
  bool const is_behind_the_end = told == 0 || (entry > 0 && number(entry - 1) + 1 >= told);
  if (is_behind_the_end) return std::nullopt;
  return std::min(number(entry), told - 1);
}

}  // namespace torquescope
