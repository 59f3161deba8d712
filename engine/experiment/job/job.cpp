#include "engine/experiment/job/job.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "engine/base/digest.hpp"
#include "engine/base/interrupted_call.hpp"
#include "engine/experiment/job/job_parser.hpp"

namespace torquescope {

namespace {

constexpr std::size_t largest_job_bytes = 1 << 20;

// closes itself; a plain descriptor because ifstream would wait for ever at a FIFO
struct Descriptor {
  int number = -1;
  explicit Descriptor(int number_) : number(number_) {}
  Descriptor(Descriptor const&) = delete;
  Descriptor& operator=(Descriptor const&) = delete;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

Error no_input(std::string what, std::string help = "") {
  Problem problem;
  problem.code = ExitCode::no_input;
  problem.what = std::move(what);
  problem.help = std::move(help);
  return Error(problem);
}

Error cannot_read(std::string const& file, int error_number) {
  Problem problem;
  problem.code = error_number == EIO ? ExitCode::io : ExitCode::no_input;
  problem.what = fmt::format("cannot read {}: {}", file, std::strerror(error_number));
  if (error_number == EIO) problem.help = "check the disk, then run the same command again";
  return Error(problem);
}

Error too_large(std::string const& file) {
  Problem problem;
  problem.what = fmt::format("{} is larger than 1 MiB", file);
  problem.place.file = file;
  problem.help = "a job is a short text; recordings are named in it, not pasted into it";
  return Error(problem);
}

// "did you mean": job files beside the one that is missing
std::string similar_job(std::filesystem::path const& path) {
  std::filesystem::path const folder = path.has_parent_path() ? path.parent_path() : ".";
  std::vector<std::string> names;
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored))
    if (entry->path().extension() == ".toml") names.push_back(entry->path().filename().string());
  std::string const close = closest_name(path.filename().string(), names);
  return close.empty() ? "" : fmt::format("did you mean {}?", (path.parent_path() / close).string());
}

std::string read_text(std::filesystem::path const& path) {
  std::string const file = path.string();
  Descriptor const descriptor(
      unless_interrupted([&] { return ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC); }));
  if (descriptor.number < 0) {
    if (errno == ENOENT || errno == ENOTDIR) throw no_input("no such file: " + file, similar_job(path));
    throw cannot_read(file, errno);
  }
  struct stat status {};
  if (::fstat(descriptor.number, &status) != 0 || !S_ISREG(status.st_mode))
    throw no_input(file + " is not a regular file", "a job is a .toml text file; jobs/ has examples");

  // as large as it says, and one byte more to see its end
  std::size_t const most = largest_job_bytes + 1;
  std::string text(std::min(most, static_cast<std::size_t>(status.st_size) + 1), '\0');
  std::size_t size = 0;
  while (size < most) {
    if (size == text.size()) text.resize(std::min(most, 2 * size));  // it grew
    ssize_t const got = ::read(descriptor.number, text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw cannot_read(file, errno);
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  text.resize(size);
  return text;
}

}  // namespace

Section const* Job::find(std::string const& name) const {
  for (auto const& section : sections)
    if (section.name == name) return &section;
  return nullptr;
}

std::vector<Section const*> Job::all(std::string const& name) const {
  std::vector<Section const*> found;
  for (auto const& section : sections)
    if (section.name == name) found.push_back(&section);
  return found;
}

std::filesystem::path Job::resolve(std::string const& name) const { return path.parent_path() / name; }

Job read_job(std::filesystem::path const& path) { return parse_job(read_text(path), path); }

Job parse_job(std::string text, std::filesystem::path const& path) {
  if (text.size() > largest_job_bytes) throw too_large(path.string());
  Job job;
  job.path = path;
  job.sha256 = sha256_hex(text);
  job.sections = parse_sections(text, path.string());
  job.text = std::move(text);
  return job;
}

}  // namespace torquescope
