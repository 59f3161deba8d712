#include "engine/data/file_bytes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/interrupted_call.hpp"
#include "engine/data/data_problem.hpp"

namespace torquescope {
namespace {

class OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(OpenFile const&) = delete;
  OpenFile& operator=(OpenFile const&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

// a name like the missing one in the same folder, or ""
std::string closest_file(std::filesystem::path const& path) {
  constexpr std::size_t most_names = 2000;
  auto const folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  std::vector<std::string> names;
  std::error_code failure;
  for (std::filesystem::directory_iterator entry(folder, failure), end;
       !failure && entry != end && names.size() < most_names; entry.increment(failure))
    names.push_back(entry->path().filename().string());
  return closest_name(path.filename().string(), names);
}

Problem cannot_open(std::filesystem::path const& path, int error) {
  Problem problem{error == EIO ? ExitCode::io : ExitCode::no_input,
                  fmt::format("cannot open {}: {}", path.string(), std::strerror(error))};
  if (error != ENOENT) return problem;
  problem.what = fmt::format("no file {}", path.string());
  auto const name = path.string();
  bool const has_control =
      std::any_of(name.begin(), name.end(), [](char letter) { return letter >= 0 && letter < ' '; });
  if (has_control) {
    problem.help = "a path of Windows? in double quotes \\t and \\n are escapes: write it in single quotes, or with /";
    return problem;
  }
  auto const similar = closest_file(path);
  problem.help = similar.empty() ? "paths are relative to the job file" : fmt::format("did you mean \"{}\"?", similar);
  return problem;
}

std::string kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  return "a device or socket";
}

int open_regular(std::filesystem::path const& path) {
  // without O_NONBLOCK opening a FIFO nobody writes to would wait for ever
  int const descriptor = unless_interrupted([&] { return ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC); });
  if (descriptor < 0) throw Error(cannot_open(path, errno));
  struct stat status {};
  bool const known = ::fstat(descriptor, &status) == 0;
  if (known && S_ISREG(status.st_mode)) return descriptor;
  ::close(descriptor);
  Problem problem{ExitCode::no_input, fmt::format("{} is {}, not a recording", path.string(), kind_of(status.st_mode))};
  problem.help = "name a regular file (.csv, .csv.gz, .h5, .mat, .npz)";
  throw Error(std::move(problem));
}

// reads until `most` bytes or the end
std::string read_bytes(OpenFile const& file, std::filesystem::path const& path, std::uint64_t most) {
  // as large as it says and a byte more to see its end, in blocks; a file that grows is read on
  constexpr std::uint64_t largest_block = std::uint64_t{1} << 22, smallest_block = 4096;
  struct stat status {};
  bool const known = ::fstat(file.descriptor(), &status) == 0;
  std::uint64_t const said = known ? static_cast<std::uint64_t>(status.st_size) + 1 : largest_block;
  std::uint64_t const block = std::clamp(said, smallest_block, largest_block);
  std::string bytes;
  while (bytes.size() < most) {
    std::size_t const before = bytes.size();
    std::size_t const wanted = static_cast<std::size_t>(std::min(block, most - before));
    bytes.resize(before + wanted);
    auto const got = ::read(file.descriptor(), bytes.data() + before, wanted);
    if (got < 0 && errno == EINTR) {
      bytes.resize(before);
      continue;
    }
    if (got < 0)
      throw Error(Problem{ExitCode::io, fmt::format("cannot read {}: {}", path.string(), std::strerror(errno))});
    bytes.resize(before + static_cast<std::size_t>(got));
    if (got == 0) break;
  }
  return bytes;
}

}  // namespace

std::string read_whole_file(std::filesystem::path const& path, std::uint64_t most_bytes) {
  OpenFile const file(open_regular(path));
  auto bytes = read_bytes(file, path, most_bytes + 1);
  validate(bytes.size() <= most_bytes, [&] {
    return bad_data(
        fmt::format("{} is larger than {} MiB, the most one recording may have", path.string(), most_bytes >> 20),
        path.string(), 0, "cut it into several recordings: recording.train takes a list");
  });
  return bytes;
}

std::string read_first_bytes(std::filesystem::path const& path, std::size_t count) {
  OpenFile const file(open_regular(path));
  return read_bytes(file, path, count);
}

std::string read_last_bytes(std::filesystem::path const& path, std::size_t count) {
  OpenFile const file(open_regular(path));
  // from the beginning where the file is shorter
  ::lseek(file.descriptor(), -static_cast<off_t>(count), SEEK_END);
  return read_bytes(file, path, count);
}

}  // namespace torquescope
