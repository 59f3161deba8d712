#include "engine/base/digest.hpp"

#include <openssl/evp.h>

#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>

namespace torquescope {

static_assert(std::endian::native == std::endian::little, "digests are defined on little-endian bytes");

struct Digest::Context {
  Context() : handle(EVP_MD_CTX_new()) {
    if (!handle || EVP_DigestInit_ex(handle, EVP_sha256(), nullptr) != 1)
      throw std::runtime_error("OpenSSL has no SHA-256");
  }
  ~Context() { EVP_MD_CTX_free(handle); }
  Context(Context const&) = delete;
  Context& operator=(Context const&) = delete;
  EVP_MD_CTX* handle;
};

Digest::Digest() : context_(std::make_unique<Context>()) {}
Digest::~Digest() = default;
Digest::Digest(Digest&&) noexcept = default;
Digest& Digest::operator=(Digest&&) noexcept = default;

Digest& Digest::bytes(void const* data, std::size_t size) {
  EVP_DigestUpdate(context_->handle, data, size);
  return *this;
}

Digest& Digest::text(std::string_view text) {
  std::uint64_t const length = text.size();
  return bytes(&length, sizeof(length)).bytes(text.data(), text.size());
}

Digest& Digest::numbers(std::span<double const> values) { return bytes(values.data(), values.size_bytes()); }

std::string Digest::hex() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> raw{};
  unsigned int length = 0;
  EVP_DigestFinal_ex(context_->handle, raw.data(), &length);
  static char const letters[] = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < length; ++i) {
    text += letters[raw[i] >> 4];
    text += letters[raw[i] & 15];
  }
  return text;
}

std::string sha256_hex(std::string_view bytes) { return Digest().bytes(bytes.data(), bytes.size()).hex(); }

}  // namespace torquescope
