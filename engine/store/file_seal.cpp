#include "engine/store/file_seal.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <vector>

#include "engine/store/disk_failure.hpp"

namespace torquescope {
namespace {

constexpr char seal_letters[] = "TORQUESCOPESEAL1";
constexpr unsigned char hdf5_letters[] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};

struct Footer {
  char letters[16];
  std::uint64_t hdf5_bytes;  // in front of the table of ranges
  std::uint64_t ranges;
  Sha256 job;
  Sha256 sha256;  // of what stands above, the table, and every byte outside its ranges
};
static_assert(sizeof(Footer) == 96);
constexpr std::size_t said_bytes = sizeof(Footer) - sizeof(Sha256);
static_assert(sizeof(ByteRange) == 16);

using ReadAt = std::function<bool(std::uint64_t offset, void* data, std::size_t size)>;

// nothing when a byte cannot be read
std::optional<Sha256> seal_digest(Footer const& footer, std::vector<ByteRange> const& values, ReadAt const& read) {
  constexpr std::uint64_t at_once = std::uint64_t{64} << 10;
  Digest digest;
  digest.bytes(&footer, said_bytes).bytes(values.data(), values.size() * sizeof(ByteRange));
  std::vector<std::byte> block(at_once);
  std::uint64_t place = 0;
  for (std::size_t i = 0; i <= values.size(); ++i) {
    std::uint64_t const end = i < values.size() ? values[i].begin : footer.hdf5_bytes;
    while (place < end) {
      auto const size = static_cast<std::size_t>(std::min(at_once, end - place));
      if (!read(place, block.data(), size)) return std::nullopt;
      digest.bytes(block.data(), size);
      place += size;
    }
    if (i < values.size()) place = values[i].end;
  }
  return digest.raw();
}

struct Found {
  Footer footer;
  bool fits;  // the lengths it tells of make up the file
};

// nothing when there is none; errno says whether the disk is why
std::optional<Found> find_footer(int descriptor) {
  struct stat facts {};
  Found found{};
  errno = 0;
  if (::fstat(descriptor, &facts) != 0 || !S_ISREG(facts.st_mode)) return std::nullopt;
  auto const size = static_cast<std::uint64_t>(facts.st_size);
  if (size < sizeof(Footer)) return std::nullopt;
  if (!read_at(descriptor, size - sizeof(Footer), &found.footer, sizeof(Footer))) return std::nullopt;
  if (std::memcmp(found.footer.letters, seal_letters, sizeof(found.footer.letters)) != 0) return std::nullopt;
  std::uint64_t const before = size - sizeof(Footer), ranges = found.footer.ranges;
  found.fits = ranges <= before / sizeof(ByteRange) &&
               found.footer.hdf5_bytes == before - ranges * static_cast<std::uint64_t>(sizeof(ByteRange));
  return found;
}

bool are_in_order(std::vector<ByteRange> const& ranges, std::uint64_t end) {
  std::uint64_t place = 0;
  for (auto const& range : ranges) {
    if (range.begin < place || range.end <= range.begin || range.end > end) return false;
    place = range.end;
  }
  return true;
}

}  // namespace

Sha256 job_identity(std::string const& inputs_sha256, Keeps keeps) {
  if (inputs_sha256.empty()) return {};
  return Digest().text(keeps == Keeps::work ? "torquescope work" : "torquescope result").text(inputs_sha256).raw();
}

void seal_file(TempFile& file, ByteRanges const& values, Sha256 const& job) {
  Footer footer{};
  std::memcpy(footer.letters, seal_letters, sizeof(footer.letters));
  footer.hdf5_bytes = file.size();
  auto const ranges = values.before(footer.hdf5_bytes);
  footer.ranges = ranges.size();
  footer.job = job;
  auto const digest = seal_digest(footer, ranges, [&](std::uint64_t offset, void* data, std::size_t size) {
    return file.read_at(offset, data, size);
  });
  file.check();
  if (!digest) throw cannot_write(file.final_name(), EIO);
  footer.sha256 = *digest;
  file.write_at(file.size(), ranges.data(), ranges.size() * sizeof(ByteRange));
  file.write_at(file.size(), &footer, sizeof(footer));
}

Seal check_seal(ReadFile const& file) {
  auto const found = find_footer(file.descriptor());
  if (!found && errno != 0) throw cannot_read(file.path(), errno);
  if (!found) return Seal::absent;
  auto const& footer = found->footer;
  if (!found->fits) return Seal::broken;
  std::vector<ByteRange> ranges(footer.ranges);
  auto const read = [&](std::uint64_t offset, void* data, std::size_t size) {
    if (read_at(file.descriptor(), offset, data, size)) return true;
    throw cannot_read(file.path(), errno != 0 ? errno : EIO);
  };
  read(footer.hdf5_bytes, ranges.data(), ranges.size() * sizeof(ByteRange));
  if (!are_in_order(ranges, footer.hdf5_bytes)) return Seal::broken;
  return seal_digest(footer, ranges, read) == footer.sha256 ? Seal::whole : Seal::broken;
}

std::optional<Sha256> sealed_identity(int descriptor) {
  unsigned char begin[sizeof(hdf5_letters)] = {};
  if (!read_at(descriptor, 0, begin, sizeof(begin)) || std::memcmp(begin, hdf5_letters, sizeof(begin)) != 0)
    return std::nullopt;
  auto const found = find_footer(descriptor);
  return found && found->fits ? std::optional(found->footer.job) : std::nullopt;
}

}  // namespace torquescope
