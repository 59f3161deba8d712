#include "concealed/noise.hpp"

#include <cmath>
#include <numbers>

namespace concealed {
namespace {

// FNV-1a, then the finaliser of splitmix64: neighbouring seeds and purposes end far apart
std::uint64_t stream_seed(std::uint64_t seed, std::string const& purpose) {
  std::uint64_t hash = 14695981039346656037ULL ^ (seed * 0x9e3779b97f4a7c15ULL);
  for (char letter : purpose) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9ULL;
  hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebULL;
  return hash ^ (hash >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::string const& purpose) : bits_(stream_seed(seed, purpose)) {}

double Random::uniform() { return (static_cast<double>(bits_() >> 11) + 0.5) * 0x1p-53; }

double Random::normal() {
  double const radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

std::size_t Random::index(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)); }

ColouredNoise::ColouredNoise(Random random, double std, double memory_s, double tick_s)
    : random_(random), std_(std), keep_(std::exp(-tick_s / memory_s)), value_(std * random_.normal()) {}

double ColouredNoise::next() {
  double const now = value_;
  value_ = keep_ * value_ + std_ * std::sqrt(1.0 - keep_ * keep_) * random_.normal();
  return now;
}

}  // namespace concealed
