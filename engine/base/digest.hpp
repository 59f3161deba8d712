#pragma once
// SHA-256 of bytes and of plain numbers (little-endian, as they lie in memory): identity of jobs, recordings and results.
//
// Threads    a Digest is a value used by one thread

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace torquescope {

class Digest {
 public:
  Digest();
  ~Digest();
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;

  Digest& bytes(void const* data, std::size_t size);
  Digest& text(std::string_view text);  // its length, then its letters
  Digest& numbers(std::span<double const> values);
  std::string hex();  // 64 letters; ends the digest

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

std::string sha256_hex(std::string_view bytes);

}  // namespace torquescope
