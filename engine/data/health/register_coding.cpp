#include "engine/data/health/register_coding.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

namespace torquescope {
namespace {

struct Coding {
  FindingKind kind;
  int bits;
};

double decoded(double value, Coding coding) {
  if (coding.kind == FindingKind::unsigned_register) {
    double const modulus = std::ldexp(1.0, coding.bits);
    return value >= modulus / 2 ? value - modulus : value;
  }
  double const sign = std::ldexp(1.0, coding.bits);
  return value >= sign ? sign - value : value;
}

double total_variation(std::vector<double> const& values, std::function<double(double)> const& of) {
  double sum = 0.0, before = std::numeric_limits<double>::quiet_NaN();
  for (double value : values) {
    if (!std::isfinite(value)) continue;
    double const now = of(value);
    if (std::isfinite(before)) sum += std::fabs(now - before);
    before = now;
  }
  return sum;
}

// The register jumps by half of its range and more where the sign changes, and the decoded signal never does
bool is_sure(std::vector<double> const& values, Coding coding) {
  double const half = std::ldexp(1.0, coding.bits - 1);
  std::size_t jumps = 0;
  double largest = 0.0, before = std::numeric_limits<double>::quiet_NaN();
  for (double value : values) {
    if (!std::isfinite(value)) continue;
    if (std::isfinite(before)) {
      jumps += std::fabs(value - before) > half;
      largest = std::max(largest, std::fabs(decoded(value, coding) - decoded(before, coding)));
    }
    before = value;
  }
  return jumps >= 2 && largest < half;
}

// whole numbers from 0 upwards, whose largest says how many bits there are at least
std::optional<double> largest_whole_number(std::vector<double> const& values) {
  double largest = 0.0;
  for (double value : values) {
    if (!std::isfinite(value)) continue;
    if (value < 0.0 || value != std::round(value)) return {};
    largest = std::max(largest, value);
  }
  return largest;
}

constexpr std::array register_bits = {8, 10, 12, 14, 16, 24, 32};
constexpr int lowest_sign_bit = 6, highest_sign_bit = 31;

std::vector<Coding> codings_for(double largest) {
  std::vector<Coding> codings;
  for (int bits : register_bits)
    if (largest < std::ldexp(1.0, bits) && largest >= std::ldexp(1.0, bits - 1))
      codings.push_back({FindingKind::unsigned_register, bits});
  for (int bit = lowest_sign_bit; bit <= highest_sign_bit; ++bit)
    if (largest > std::ldexp(1.0, bit) && largest < std::ldexp(1.0, bit + 1))
      codings.push_back({FindingKind::sign_magnitude, bit});
  return codings;
}

// the coding that leaves the shortest way from row to row, and how much shorter it is
struct Found {
  Coding coding;
  double ratio;
};

std::optional<Found> best_coding(std::vector<double> const& values, std::vector<FindingKind> const& kinds) {
  auto const largest = largest_whole_number(values);
  if (!largest || *largest < 64.0) return {};
  double const plain = total_variation(values, [](double v) { return v; });
  if (!(plain > 0.0)) return {};  // a constant has no sign to lose
  std::optional<Found> best;
  for (auto const& coding : codings_for(*largest)) {
    if (std::find(kinds.begin(), kinds.end(), coding.kind) == kinds.end()) continue;
    double const ratio = total_variation(values, [&](double v) { return decoded(v, coding); }) / plain;
    if (!best || ratio < best->ratio) best = Found{coding, ratio};
  }
  return best;
}

std::vector<std::size_t> decode(std::vector<double>& values, Coding coding) {
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < values.size(); ++i) {
    double const now = std::isfinite(values[i]) ? decoded(values[i], coding) : values[i];
    if (now != values[i] && std::isfinite(now)) changed.push_back(i);
    values[i] = now;
  }
  return changed;
}

// what the job writes: plain, unsigned8 to unsigned32, sign_magnitude (its bit is sought), sign_magnitude8 to 32
std::optional<Coding> asked_coding(std::string const& word, std::vector<double> const& values) {
  std::string const unsigned_word = "unsigned", sign_word = "sign_magnitude";
  if (word == sign_word) {
    auto const found = best_coding(values, {FindingKind::sign_magnitude});
    return found ? std::optional(found->coding) : std::nullopt;
  }
  if (word.starts_with(unsigned_word)) return Coding{FindingKind::unsigned_register, std::stoi(word.substr(8))};
  if (word.starts_with(sign_word)) return Coding{FindingKind::sign_magnitude, std::stoi(word.substr(14)) - 1};
  return {};
}

void decode_channel(Examination& exam, std::string const& channel, std::vector<FindingKind> const& kinds) {
  constexpr double shorter = 0.9;
  if (!exam.has(channel)) return;
  auto& values = exam.values(channel);
  auto const asked = exam.options.encoding.find(channel);
  if (asked != exam.options.encoding.end()) {
    auto const coding = asked_coding(asked->second, values);
    if (!coding) return;
    auto const rows = decode(values, *coding);
    exam.add(coding->kind, Grade::note, Repair::corrected, channel, rows, coding->bits, channel);
    return;
  }
  auto const found = best_coding(values, kinds);
  if (!found || found->ratio > shorter) return;
  if (!is_sure(values, found->coding)) {
    auto copy = values;
    exam.add(found->coding.kind, Grade::fault, Repair::none, channel, decode(copy, found->coding), found->coding.bits,
             channel);
    return;
  }
  auto const rows = decode(values, found->coding);
  exam.add(found->coding.kind, Grade::warning, Repair::corrected, channel, rows, found->coding.bits, channel);
}

}  // namespace

bool is_encoding(std::string const& word) {
  if (word == "plain" || word == "sign_magnitude") return true;
  auto const is_one_of = [&](std::string const& begin, auto const& numbers) {
    return std::any_of(numbers.begin(), numbers.end(), [&](int n) { return word == begin + std::to_string(n); });
  };
  std::vector<int> all_bits;
  for (int bit = lowest_sign_bit; bit <= highest_sign_bit; ++bit) all_bits.push_back(bit + 1);
  return is_one_of("unsigned", register_bits) || is_one_of("sign_magnitude", all_bits);
}

void decode_registers(Examination& exam) {
  using enum FindingKind;
  decode_channel(exam, "torque", {unsigned_register, sign_magnitude});
  decode_channel(exam, "velocity", {unsigned_register, sign_magnitude});
  // a position that passes the end of its counter is unwrapped
  decode_channel(exam, "position", {sign_magnitude});
  decode_channel(exam, "reference", {sign_magnitude});
}

}  // namespace torquescope
