// Throws seeds, and seeds with a few bytes changed, at one reader: the same ones in every build, everywhere.
//
// Use        short_pass READER FOLDER_OF_SEEDS COUNT
// Proves     each is read or refused with an Error, within seconds. What a foreign library parses is read in a child,
//            as the program does, and the child may end in any way; of our own parsers a batch shares a child, which
//            must not
// Exit       0, or 1 with the input that broke the effect, kept as finding.READER in the working folder. What broke a
//            library off is kept as broke_off.READER.0, .1, ...: the program has to refuse it

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "engine/base/confined.hpp"
#include "engine/base/error.hpp"
#include "engine/base/random_stream.hpp"
#include "tests/fuzz/hostile_reader.hpp"

namespace torquescope {
namespace {

constexpr std::uint64_t seed = 20140608;

std::map<std::string, HostileReader const*> const readers{
    {"job", &hostile_job},   {"csv", &hostile_csv}, {"hdf5", &hostile_hdf5},         {"json", &hostile_json},
    {"mat5", &hostile_mat5}, {"npz", &hostile_npz}, {"ros_echo", &hostile_ros_echo}, {"segment", &hostile_segment}};

std::vector<std::string> contents_of(std::filesystem::path const& folder) {
  std::vector<std::filesystem::path> names;
  for (auto const& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path());
  std::sort(names.begin(), names.end());
  std::vector<std::string> contents;
  for (auto const& name : names) {
    std::ifstream file(name, std::ios::binary);
    contents.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return contents;
}

class Inputs {
 public:
  Inputs(std::vector<std::string> seeds, HostileReader const& reader) : seeds_(std::move(seeds)), reader_(reader) {}

  std::size_t seeds() const { return seeds_.size(); }
  // the seeds themselves, then what becomes of them
  std::string operator()(std::uint32_t number) const {
    if (number < seeds_.size()) return seeds_[number];
    RandomStream draw({seed, 0, RandomDomain::test}, 0, number);
    std::string bytes = seeds_[draw.below(count_of(seeds_))];
    for (std::uint32_t changes = 1 + draw.below(4); changes > 0; --changes) change(bytes, draw);
    if (reader_.mend) reader_.mend({reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size()});
    return bytes;
  }

 private:
  template <class List>
  static std::uint32_t count_of(List const& list) {
    return static_cast<std::uint32_t>(list.size());
  }

  void change(std::string& bytes, RandomStream& draw) const {
    constexpr unsigned char extremes[] = {0, 1, 9, 10, 127, 128, 254, 255};
    if (bytes.empty()) bytes = "\n";
    std::uint32_t const place = draw.below(count_of(bytes));
    std::uint32_t const length = 1 + draw.below(std::min<std::uint32_t>(64, count_of(bytes) - place));
    switch (draw.below(6)) {
      case 0:
      case 1:
        bytes[place] = static_cast<char>(bytes[place] ^ 1 << draw.below(8));
        break;
      case 2:
        bytes[place] = static_cast<char>(extremes[draw.below(8)]);
        break;
      case 3:
        bytes.erase(place, length);
        break;
      case 4:
        bytes.insert(draw.below(count_of(bytes)), bytes.substr(place, length));
        break;
      default: {  // a piece of another one
        std::string const& other = seeds_[draw.below(count_of(seeds_))];
        if (!other.empty()) bytes.replace(place, length, other.substr(draw.below(count_of(other)), length));
      }
    }
  }

  std::vector<std::string> seeds_;
  HostileReader const& reader_;
};

struct Outcome {
  std::size_t read = 0, refused = 0;
  std::string broke_off{};
};

// [first, end) in a child
Outcome try_inputs(Inputs const& inputs, HostileReader const& reader, std::uint32_t first, std::uint32_t end) {
  auto const read_all = [&] {
    std::string refused;  // a letter each: what a child returns is text
    for (std::uint32_t number = first; number < end; ++number) {
      std::string const bytes = inputs(number);
      try {
        reader.read(bytes);
      } catch (Error const&) {
        refused += 'r';
      }
    }
    return refused;
  };
  try {
    std::size_t const refused =
        run_confined(read_all, {.processor_seconds = reader.foreign ? 1 : 20}, [](std::string const& how) {
          return Problem{.what = how};
        }).size();
    return {end - first - refused, refused};
  } catch (Error const& error) {
    return {0, 0, error.problems().front().what};
  }
}

void keep(Inputs const& inputs, std::string const& file, std::uint32_t number) {
  std::ofstream(file, std::ios::binary) << inputs(number);
}

int report_finding(Inputs const& inputs, std::string const& name, std::uint32_t number, std::string const& how) {
  keep(inputs, "finding." + name, number);
  fmt::print(stderr, "input {} of reader {}: {}; kept as finding.{}\n", number, name, how, name);
  return 1;
}

int pass(std::string const& name, std::filesystem::path const& folder, std::uint32_t count) {
  HostileReader const& reader = *readers.at(name);
  Inputs const inputs(contents_of(folder), reader);
  std::uint32_t const end = count + static_cast<std::uint32_t>(inputs.seeds());
  std::uint32_t const batch = reader.foreign ? 1 : 500;
  std::size_t read = 0, refused = 0, broke_off = 0;
  for (std::uint32_t first = 0; first < end; first += batch) {
    Outcome const outcome = try_inputs(inputs, reader, first, std::min(end, first + batch));
    read += outcome.read;
    refused += outcome.refused;
    if (outcome.broke_off.empty()) continue;
    if (reader.foreign) keep(inputs, fmt::format("broke_off.{}.{}", name, broke_off), first);
    ++broke_off;
    if (reader.foreign) continue;
    for (std::uint32_t number = first; number < end; ++number)
      if (auto const one = try_inputs(inputs, reader, number, number + 1); !one.broke_off.empty())
        return report_finding(inputs, name, number, one.broke_off);
    return report_finding(inputs, name, first, outcome.broke_off + ", in a batch");
  }
  fmt::print("{}: {} seeds, {} changed: {} read, {} refused", name, inputs.seeds(), count, read, refused);
  if (reader.foreign) fmt::print(", in {} the library crashed or looped", broke_off);
  fmt::print("\n");
  return 0;
}

}  // namespace
}  // namespace torquescope

int main(int count, char** words) {
  if (count != 4 || !torquescope::readers.contains(words[1])) return 64;
  return torquescope::pass(words[1], words[2], static_cast<std::uint32_t>(std::atoi(words[3])));
}
