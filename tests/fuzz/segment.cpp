// Segments: engine/experiment/runs/segment_file.cpp.
// Their parts are read without the proof of their digest, which no change
// survives: what a file says of itself may be wrong, but must not lead outside.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "engine/experiment/runs/segment_file.hpp"
#include "tests/fuzz/header_checksums.hpp"
#include "tests/fuzz/hostile_reader.hpp"
#include "tests/fuzz/seal.hpp"

namespace torquescope {
namespace {

// in the working folder, where whoever runs this clears up: HDF5 opens no file without a name
class ScratchFile {
 public:
  explicit ScratchFile(std::string_view bytes) : name_("scratch." + std::to_string(::getpid())) {
    std::ofstream(name_, std::ios::binary) << bytes;
  }
  ~ScratchFile() { std::filesystem::remove(name_); }
  ScratchFile(ScratchFile const&) = delete;
  ScratchFile& operator=(ScratchFile const&) = delete;
  std::string const& name() const { return name_; }

 private:
  std::string name_;
};

void read_segment(std::string_view bytes) {
  ScratchFile const file(bytes);
  SegmentFile segment(file.name());
  for (auto const& [label, index] : segment.estimators()) {
    for (std::size_t entry = 0; entry < index.entries.size(); ++entry) {
      RunPart const part = segment.read(label, entry);
      RunHistory history;
      append(history, part, index.shape, part.first);
      if (first_difference(history, part, index.shape) < part.first)
        throw std::logic_error("a part differs before it begins");
    }
  }
  segment.verify();
}

void mend_segment(std::span<std::uint8_t> bytes) {
  renew_header_checksums(bytes);
  renew_seal(bytes);
}

}  // namespace

HostileReader const hostile_segment{.read = read_segment, .mend = mend_segment, .foreign = true};

}  // namespace torquescope
