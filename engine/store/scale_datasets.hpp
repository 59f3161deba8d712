#pragma once
// Datasets that exist to be scales (dimension_scales.hpp): <group>/<dimension> says what stands along it.
//
// Errors     those of ResultWriter

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "engine/store/result_writer.hpp"

namespace torquescope {

// 0, 1, 2, ...: of what is only counted
void write_index(ResultWriter& writer, std::string const& group, std::string const& dimension, std::size_t count);
void write_numbers(ResultWriter& writer, std::string const& group, std::string const& dimension,
                   std::span<std::int64_t const> numbers);
// of what has a name
void write_names(ResultWriter& writer, std::string const& group, std::string const& dimension,
                 std::span<std::string const> names);
// dimension "bound": the two ends of an interval
void write_bounds(ResultWriter& writer, std::string const& group);

}  // namespace torquescope
