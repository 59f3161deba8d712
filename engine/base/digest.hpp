#pragma once
// SHA-256 of bytes and of plain numbers (little-endian, as they lie in memory): identity of jobs, recordings and
// results.
//
// Threads    a Digest is a value used by one thread

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace torquescope {

using Sha256 = std::array<unsigned char, 32>;

class Digest {
 public:
  Digest();
  ~Digest();
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;

  Digest& bytes(void const* data, std::size_t size);
  Digest& text(std::string_view text);  // its length, then its letters
  Digest& numbers(std::span<double const> values);
  Sha256 raw();       // ends the digest
  std::string hex();  // the same as 64 letters

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

std::string sha256_hex(std::string_view bytes);

}  // namespace torquescope
