#include "engine/store/number_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "engine/base/interrupted_call.hpp"
#include "engine/store/temp_file.hpp"

namespace torquescope {
namespace {

struct Head {
  char letters[8];
  Sha256 job, key;
  std::uint64_t count;
};
static_assert(sizeof(Head) == 80);

Head head_of(NumberFileKey const& key, std::size_t count) {
  return {{'T', 'S', 'N', 'U', 'M', 'S', '0', '2'}, key.job, key.key, static_cast<std::uint64_t>(count)};
}

Sha256 digest_of(Head const& head, std::span<double const> numbers) {
  return Digest().bytes(&head, sizeof head).numbers(numbers).raw();
}

class OpenFile {
 public:
  // O_NONBLOCK: a FIFO under this name must not be waited for
  explicit OpenFile(FilePlace const& place)
      : descriptor_(unless_interrupted([&] {
          return ::openat(place.folder, place.name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
        })) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(OpenFile const&) = delete;
  OpenFile& operator=(OpenFile const&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  bool has_bytes(std::size_t wanted) const {
    struct stat facts {};
    return ::fstat(descriptor_, &facts) == 0 && S_ISREG(facts.st_mode) &&
           static_cast<std::uint64_t>(facts.st_size) == wanted;
  }
  bool read(void* to, std::size_t size) const {
    auto* bytes = static_cast<char*>(to);
    while (size > 0) {
      ssize_t const got = unless_interrupted([&] { return ::read(descriptor_, bytes, size); });
      if (got <= 0) return false;
      bytes += got;
      size -= static_cast<std::size_t>(got);
    }
    return true;
  }

 private:
  int descriptor_;
};

}  // namespace

std::size_t number_file_bytes(std::size_t numbers) { return sizeof(Head) + numbers * sizeof(double) + sizeof(Sha256); }

void write_number_file(FilePlace const& place, NumberFileKey const& key, std::span<double const> numbers) {
  Head const head = head_of(key, numbers.size());
  Sha256 const digest = digest_of(head, numbers);
  TempFile file(place, number_file_bytes(numbers.size()));
  file.write_at(0, &head, sizeof head);
  file.write_at(sizeof head, numbers.data(), numbers.size_bytes());
  file.write_at(sizeof head + numbers.size_bytes(), digest.data(), digest.size());
  file.publish();
}

NumberFile read_number_file(FilePlace const& place, NumberFileKey const& key, std::span<double> numbers) {
  OpenFile const file(place);
  if (!file.is_open()) return errno == ENOENT ? NumberFile::missing : NumberFile::foreign;
  Head const wanted = head_of(key, numbers.size());
  Head head{};
  if (!file.read(&head, sizeof head) || std::memcmp(head.letters, wanted.letters, sizeof head.letters) != 0 ||
      head.job != wanted.job)
    return NumberFile::foreign;
  // nothing is said about its numbers, nobody wants them
  if (head.key != wanted.key) return NumberFile::outdated;
  Sha256 digest{};
  bool const is_read = head.count == wanted.count && file.has_bytes(number_file_bytes(numbers.size())) &&
                       file.read(numbers.data(), numbers.size_bytes()) && file.read(digest.data(), digest.size());
  return is_read && digest == digest_of(wanted, numbers) ? NumberFile::whole : NumberFile::damaged;
}

std::optional<Sha256> number_file_identity(int descriptor) {
  Head const ours = head_of({}, 0);
  Head head{};
  bool const is_read = unless_interrupted([&] { return ::pread(descriptor, &head, sizeof head, 0); }) == sizeof head;
  if (!is_read || std::memcmp(head.letters, ours.letters, sizeof head.letters) != 0) return std::nullopt;
  return head.job;
}

}  // namespace torquescope
