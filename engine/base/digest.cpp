// the plain functions rather than EVP: looking up a provider takes OpenSSL 3 more than a millisecond per process
#define OPENSSL_SUPPRESS_DEPRECATED

#include "engine/base/digest.hpp"

#include <openssl/sha.h>

#include <bit>
#include <cstdint>

namespace torquescope {

static_assert(std::endian::native == std::endian::little, "digests are defined on little-endian bytes");

struct Digest::Context {
  Context() { SHA256_Init(&state); }
  SHA256_CTX state;
};

Digest::Digest() : context_(std::make_unique<Context>()) {}
Digest::~Digest() = default;
Digest::Digest(Digest&&) noexcept = default;
Digest& Digest::operator=(Digest&&) noexcept = default;

Digest& Digest::bytes(void const* data, std::size_t size) {
  SHA256_Update(&context_->state, data, size);
  return *this;
}

Digest& Digest::text(std::string_view text) {
  std::uint64_t const length = text.size();
  return bytes(&length, sizeof(length)).bytes(text.data(), text.size());
}

Digest& Digest::numbers(std::span<double const> values) { return bytes(values.data(), values.size_bytes()); }

Sha256 Digest::raw() {
  Sha256 raw{};
  SHA256_Final(raw.data(), &context_->state);
  return raw;
}

std::string Digest::hex() {
  static char const letters[] = "0123456789abcdef";
  std::string text;
  for (unsigned char byte : raw()) {
    text += letters[byte >> 4];
    text += letters[byte & 15];
  }
  return text;
}

std::string sha256_hex(std::string_view bytes) { return Digest().bytes(bytes.data(), bytes.size()).hex(); }

}  // namespace torquescope
