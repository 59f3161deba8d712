#include "engine/health/reference_channel.hpp"

#include <limits>
#include <optional>

#include "engine/data/known_factors.hpp"
#include "engine/data/levels.hpp"

namespace torquescope {
namespace {

struct Moments {
  double qq = 0.0, rr = 0.0, qr = 0.0;  // without the means

  // ||q - f r|| / ||q||
  double error(double factor) const {
    return std::sqrt(std::max(0.0, qq - 2.0 * factor * qr + factor * factor * rr) / qq);
  }
};

Moments moments_of(std::vector<double> const& q, std::vector<double> const& r) {
  double count = 0, mean_q = 0, mean_r = 0;
  auto const for_each = [&](auto const& visit) {
    for (std::size_t i = 0; i < q.size(); ++i)
      if (std::isfinite(q[i]) && std::isfinite(r[i])) visit(q[i], r[i]);
  };
  for_each([&](double a, double b) { mean_q += a, mean_r += b, ++count; });
  mean_q /= count, mean_r /= count;
  Moments moments;
  for_each([&](double a, double b) {
    moments.qq += (a - mean_q) * (a - mean_q);
    moments.rr += (b - mean_r) * (b - mean_r);
    moments.qr += (a - mean_q) * (b - mean_r);
  });
  return moments;
}

// the value that stands for "no command": far beyond all others and there again and again
std::optional<double> stop_code_of(std::vector<double> const& values) {
  constexpr double far_beyond = 20.0;      // ranges of all others
  constexpr std::size_t fewest_held = 10;  // fewer are wrong rows
  for (bool const is_above : {true, false}) {
    double extreme = is_above ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    for (double value : values)
      if (std::isfinite(value)) extreme = is_above ? std::max(extreme, value) : std::min(extreme, value);
    std::vector<double> others;
    std::size_t held = 0;
    for (double value : values) {
      if (value == extreme)
        ++held;
      else
        others.push_back(value);
    }
    double const range = range_of(others);
    if (known_rows(others).empty()) return {};  // a constant: no_command.hpp
    double nearest = std::numeric_limits<double>::infinity();
    for (double value : others)
      if (std::isfinite(value)) nearest = std::min(nearest, std::fabs(value - extreme));
    if (held >= fewest_held && range > 0.0 && nearest > far_beyond * range) return extreme;
  }
  return {};
}

}  // namespace

void take_out_stop_codes(Examination& exam) {
  constexpr double mostly = 0.5;
  if (!exam.has("reference")) return;
  auto& values = exam.values("reference");
  if (known_rows(values).empty()) {
    exam.add(FindingKind::reference_constant, Grade::warning, Repair::channel_unused, "reference", {}, missing);
    exam.channels.erase("reference");
    return;
  }
  auto const code = stop_code_of(values);
  if (!code) return;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < values.size(); ++row)
    if (values[row] == *code) rows.push_back(row);
  std::size_t const known = known_rows(values).size();
  if (static_cast<double>(rows.size()) < mostly * static_cast<double>(known)) {
    for (std::size_t row : rows) values[row] = missing;
    exam.add(FindingKind::reference_constant, Grade::warning, Repair::left_out, "reference", rows, *code);
    return;
  }
  bool const is_everywhere = rows.size() == known;
  exam.add(FindingKind::reference_constant, Grade::warning, Repair::channel_unused, "reference",
           is_everywhere ? std::vector<std::size_t>() : rows, *code);
  exam.channels.erase("reference");
}

void examine_reference(Examination& exam) {
  if (!exam.has("reference")) return;
  Moments const moments = moments_of(exam.values("position"), exam.values("reference"));
  if (!(moments.qq > 0.0) || !(moments.rr > 0.0)) return;
  double const before = moments.error(1.0);
  struct Best {
    double factor, error;  // of the reference
    KnownFactor const* known;
    bool is_of_position;
  } best{1.0, before, nullptr, false};
  for (auto const& known : angle_factors())
    for (bool const is_of_position : {false, true}) {
      double const factor = is_of_position ? 1.0 / known.factor : known.factor;
      if (double const error = moments.error(factor); error < best.error)
        best = {factor, error, &known, is_of_position};
    }
  // and the position follows: a joint that lags far behind its reference tells no unit
  bool const follows = levels::factor_worth_saying * best.error <= 1.0;
  if (best.known == nullptr || !follows || !(before >= levels::factor_worth_saying * best.error)) return;
  bool const is_unit_of_position = best.is_of_position && !exam.writes("position_per_unit");
  auto& finding = is_unit_of_position
                      ? exam.add(FindingKind::position_factor, Grade::fault, Repair::none, "position", {},
                                 best.known->factor, best.known->words)
                      : exam.add(FindingKind::reference_factor, Grade::warning, Repair::corrected, "reference", {},
                                 best.factor, best.is_of_position ? std::string() : best.known->words);
  finding.error_before = before;
  finding.error_after = best.error;
  if (is_unit_of_position) return;
  for (double& value : exam.values("reference")) value *= best.factor;
}

}  // namespace torquescope
