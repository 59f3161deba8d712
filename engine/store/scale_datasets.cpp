#include "engine/store/scale_datasets.hpp"

#include <numeric>
#include <vector>

namespace torquescope {

void write_index(ResultWriter& writer, std::string const& group, std::string const& dimension, std::size_t count) {
  std::vector<std::int64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
  write_numbers(writer, group, dimension, numbers);
}

void write_numbers(ResultWriter& writer, std::string const& group, std::string const& dimension,
                   std::span<std::int64_t const> numbers) {
  writer.whole_numbers(group + "/" + dimension, {numbers.size()}, numbers, Note{"1", dimension}.over({dimension}));
}

void write_names(ResultWriter& writer, std::string const& group, std::string const& dimension,
                 std::span<std::string const> names) {
  writer.texts(group + "/" + dimension, names, Note{"1", dimension}.over({dimension}));
}

void write_bounds(ResultWriter& writer, std::string const& group) {
  write_names(writer, group, "bound", std::vector<std::string>{"low", "high"});
}

}  // namespace torquescope
