#include "engine/base/memory_file.hpp"
#include "engine/data/recording_reader.hpp"
#include "tests/fuzz/hostile_reader.hpp"

namespace torquescope {

void read_recording(char const* reader, std::string_view bytes) {
  MemoryFile const file(bytes);
  for (auto const& choice : reader_choices()) {
    if (choice.name != reader) continue;
    RawTable const table = choice.read(file.path());
    for (auto const& column : table.columns)
      if (column.size() != table.columns.front().size()) throw std::logic_error("columns of different lengths");
    if (table.names.size() != table.columns.size()) throw std::logic_error("as many names as columns");
  }
}

}  // namespace torquescope
