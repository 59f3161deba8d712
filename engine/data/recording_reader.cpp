#include "engine/data/recording_reader.hpp"

#include <fmt/format.h>

#include "engine/data/confined_reader.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/data/foreign_file.hpp"
#include "engine/data/ros_stamp.hpp"
#include "engine/data/unwritten_tail.hpp"

namespace torquescope {

#define TORQUESCOPE_CHOICE(name) ReaderChoice name##_reader();
#include "reader_choices.inc"
#undef TORQUESCOPE_CHOICE

std::vector<ReaderChoice> const& reader_choices() {
#define TORQUESCOPE_CHOICE(name) name##_reader(),
  static std::vector<ReaderChoice> const choices{
#include "reader_choices.inc"
  };
#undef TORQUESCOPE_CHOICE
  return choices;
}

namespace {

// where the job names this file; train and validate are lists of paths relative to the job
SourcePlace place_of_path(std::filesystem::path const& path, Section const& section) {
  for (auto const* key : {"train", "validate"}) {
    auto const* setting = section.find(key);
    if (setting == nullptr) continue;
    auto const names = converted(setting->value, std::vector<std::string>{});
    if (!names) continue;
    for (auto const& name : std::get<std::vector<std::string>>(*names))
      if (path.string().ends_with(name)) return setting->value_place;
  }
  return section.place;
}

[[noreturn]] void rethrow_with_place(Error const& error, SourcePlace const& place) {
  auto problems = error.problems();
  for (auto& problem : problems)
    if (problem.place.file.empty()) problem.place = place;
  throw Error(std::move(problems));
}

RawTable read_with(ReaderChoice const& reader, std::filesystem::path const& path) {
  return reader.library.empty() ? reader.read(path) : read_confined(path, reader.read, reader.library);
}

// what tables of every format need
RawTable mended(RawTable table) {
  drop_unwritten_tail(table);
  add_ros_stamps(table);
  return table;
}

}  // namespace

RawTable read_table(std::filesystem::path const& path, Section const& section) {
  constexpr std::size_t enough_for_signatures = 4096;
  try {
    if (auto const folder = foreign_folder(path)) throw Error(*folder);
    auto const first_bytes = read_first_bytes(path, enough_for_signatures);
    if (auto const foreign = foreign_file(path, first_bytes)) throw Error(*foreign);
    for (auto const& reader : reader_choices())
      if (reader.accepts(path, first_bytes)) return mended(read_with(reader, path));
    auto problem = bad_data(fmt::format("{} is in no format known here", path.string()), path.string(), 0,
                            "export the recording as CSV");
    for (auto const& reader : reader_choices()) problem.notes.push_back(reader.name + ": " + reader.meaning);
    throw Error(std::move(problem));
  } catch (Error const& error) {
    rethrow_with_place(error, place_of_path(path, section));
  }
}

}  // namespace torquescope
