#include "engine/data/recorded_tables.hpp"

#include "engine/base/digest.hpp"
#include "engine/data/table_builder.hpp"
#include "engine/data/unwritten_tail.hpp"

namespace torquescope {

// NOLINTNEXTLINE(performance-unnecessary-value-param): names and values are moved out of it
RawTable table_in_memory(std::string name, NamedColumns columns) {
  Digest digest;
  for (auto const& [column, values] : columns) digest.text(column).numbers(values);
  TableBuilder builder(std::move(name), digest.hex());
  for (auto& [column, values] : columns) {
    builder.reserve(values.size(), 1, column);
    builder.add(std::move(column), std::move(values));
  }
  RawTable table = std::move(builder).finish();
  drop_unwritten_tail(table);
  return table;
}

}  // namespace torquescope
