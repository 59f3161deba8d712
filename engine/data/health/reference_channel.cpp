#include "engine/data/health/reference_channel.hpp"

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

}  // namespace

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
