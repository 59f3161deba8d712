#include "engine/experiment/arm_payloads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/experiment/job_sections.hpp"
#include "engine/fit/statistics/student_t.hpp"

namespace torquescope {

namespace {

void check_count(Section const& section, char const* key, std::vector<double> const& numbers, std::size_t each,
                 std::size_t recordings, std::vector<Problem>& problems) {
  if (numbers.empty() || numbers.size() == each * recordings) return;
  auto const some = [](std::size_t n, char const* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); };
  problems.push_back(
      problem_at(section, key,
                 fmt::format("{} has {}, for {}", key, some(numbers.size(), "number"), some(recordings, "recording")),
                 each == 1 ? "write one number a recording; 0 where the arm carries nothing"
                           : "write three numbers a recording: x, y, z; 0, 0, 0 where the arm carries nothing"));
}

// "unknown" is read as NaN
std::optional<double> mass_of(double written) { return std::isnan(written) ? std::nullopt : std::optional(written); }

void check_masses(Section const& section, char const* key, std::vector<double> const& masses,
                  std::vector<Problem>& problems) {
  if (std::all_of(masses.begin(), masses.end(), [](double mass) { return !mass_of(mass) || mass >= 0.0; })) return;
  problems.push_back(problem_at(section, key, "a payload's mass is below 0", "write what the scales show, in kg"));
}

// first moments say something of a mass that is stated
void check_moments(Section const& section, RecordingOptions const& options, std::vector<Problem>& problems) {
  auto const& moments = options.payload_first_moments_kgm;
  for (std::size_t k = 0; 3 * k < moments.size(); ++k)
    if (!(options.payload_kg[k] > 0.0) &&
        (moments[3 * k] != 0.0 || moments[3 * k + 1] != 0.0 || moments[3 * k + 2] != 0.0))
      problems.push_back(problem_at(section, "payload_first_moments_kgm",
                                    fmt::format("recording {} carries {}, and has first moments", k + 1,
                                                mass_of(options.payload_kg[k]) ? "nothing" : "an unknown mass"),
                                    "write its mass into payload_kg, or 0, 0, 0"));
}

// those of the training recordings, each once
void find_payloads(RecordingOptions const& options, PayloadPlan& plan) {
  auto const& moments = options.payload_first_moments_kgm;
  for (std::size_t k = 0; k < options.payload_kg.size(); ++k) {
    Payload payload{mass_of(options.payload_kg[k]), {}};
    if (payload.mass_kg == 0.0) continue;
    if (!moments.empty() && payload.mass_kg)
      payload.first_moments = Eigen::Vector3d(moments[3 * k], moments[3 * k + 1], moments[3 * k + 2]);
    auto const same = std::find(plan.payloads.begin(), plan.payloads.end(), payload);
    plan.train[k] = static_cast<std::size_t>(same - plan.payloads.begin());
    if (same == plan.payloads.end()) plan.payloads.push_back(payload);
  }
}

void find_validation_payloads(Section const& section, std::vector<double> const& masses, PayloadPlan& plan,
                              std::vector<Problem>& problems) {
  for (std::size_t k = 0; k < masses.size(); ++k) {
    if (masses[k] == 0.0) continue;
    auto const same = std::find_if(plan.payloads.begin(), plan.payloads.end(),
                                   [&](Payload const& payload) { return payload.mass_kg == mass_of(masses[k]); });
    if (same == plan.payloads.end())
      problems.push_back(problem_at(section, "validate_payload_kg",
                                    mass_of(masses[k]) ? fmt::format("no training recording carries {:g} kg", masses[k])
                                                       : "no training recording carries an unknown load",
                                    "what is not known of a payload is found in training: carry it there too"));
    else
      plan.validate[k] = static_cast<std::size_t>(same - plan.payloads.begin());
  }
}

bool are_different(CarriedPayloads const& carried) {
  return std::any_of(carried.begin(), carried.end(), [&](auto const& one) { return one != carried.front(); });
}

}  // namespace

PayloadPlan plan_payloads(Job const& job, RecordingOptions const& options, bool has_drive_gains,
                          std::vector<Problem>& problems) {
  Section const section = section_or_empty(job, "recording");
  std::size_t const before = problems.size();
  check_count(section, "payload_kg", options.payload_kg, 1, options.train.size(), problems);
  check_count(section, "payload_first_moments_kgm", options.payload_first_moments_kgm, 3, options.train.size(),
              problems);
  if (options.payload_kg.empty() && !options.payload_first_moments_kgm.empty())
    problems.push_back(problem_at(section, "payload_first_moments_kgm", "payload_first_moments_kgm without payload_kg",
                                  "write payload_kg as well: one mass a recording"));
  check_count(section, "validate_payload_kg", options.validate_payload_kg, 1, options.validate.size(), problems);
  check_masses(section, "payload_kg", options.payload_kg, problems);
  check_masses(section, "validate_payload_kg", options.validate_payload_kg, problems);
  PayloadPlan plan;
  plan.train.resize(options.train.size());
  plan.validate.resize(options.validate.size());
  if (problems.size() == before) check_moments(section, options, problems);
  if (problems.size() > before) return plan;
  find_payloads(options, plan);
  find_validation_payloads(section, options.validate_payload_kg, plan, problems);
  bool const has_unknown =
      std::any_of(plan.payloads.begin(), plan.payloads.end(), [](Payload const& one) { return !one.mass_kg; });
  if (has_unknown && !are_different(plan.train))
    problems.push_back(problem_at(section, "payload_kg", "a load of unknown mass is in every training recording",
                                  "record once without it, and write payload_kg = [0, \"unknown\"]"));
  if (has_drive_gains && !are_different(plan.train))
    problems.push_back(problem_at(
        section_or_empty(job, "model"), "drive_gains", "drive_gains needs training recordings with different payloads",
        "record once without and once with a weighed payload, and write payload_kg = [0, 5.0] "
        "into [recording]"));
  return plan;
}

std::string payload_words(ArmModel const& model, LeastSquaresFit const& fit) {
  std::vector<std::string> const names = model.names();
  std::vector<std::string> words;
  if (fit.standard_error.size() != fit.parameters.size()) return {};
  for (std::size_t p = 0; p < model.payloads().size(); ++p) {
    auto const& own = model.payloads()[p].names;
    auto const mass = std::find(own.begin(), own.end(), fmt::format("m{}", model.joints()));
    if (mass == own.end()) continue;  // known, or a sum of others
    auto const at = std::find(names.begin(), names.end(), fmt::format("payload{}_{}", p + 1, *mass)) - names.begin();
    double const value = fit.parameters[at], error = normal_quantile_975 * fit.standard_error[at];
    std::string text = fmt::format("payload {}: {:.4g} +- {:.2g} kg", p + 1, value, error);
    if (!std::isfinite(error)) continue;
    bool const has_all = own.size() == static_cast<std::size_t>(numbers_per_link);
    if (has_all && value > error && fit.covariance_hac.rows() == fit.parameters.size()) {
      // its first four
      PayloadCentre const found =
          payload_centre(model.chain(), fit.parameters.segment<4>(at), fit.covariance_hac.block<4, 4>(at, at));
      std::vector<std::string> axes;
      for (Eigen::Index k = 0; k < 3; ++k)
        axes.push_back(fmt::format("{:.3f} +- {:.2g}", found.centre_m[k], normal_quantile_975 * found.centre_error[k]));
      text += fmt::format(", centre at {} m in the frame of the tip", fmt::join(axes, ", "));
    }
    words.push_back(text + " (95 %)");
  }
  return fmt::format("{}", fmt::join(words, "; "));
}

void refuse_useless_payloads(Experiment::Parts const& parts, std::vector<Problem>& problems) {
  if (parts.arm->model.gain_columns().empty()) return;
  auto const& payloads = parts.arm->model.payloads();
  if (!payloads.empty() &&
      std::none_of(payloads.begin(), payloads.end(), [](auto const& payload) { return payload.tells_scale; }))
    problems.push_back(problem_at(section_or_empty(parts.job, "model"), "drive_gains",
                                  "no torque of this arm tells a payload's mass from its other numbers",
                                  "state payload_first_moments_kgm as well, or leave drive_gains out"));
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < parts.estimators.size(); ++i)
    if (parts.estimators[i].needs_instruments)
      problems.push_back(problem_at(*sections[i], "name",
                                    fmt::format("{} finds no drive gains", parts.estimators[i].kind),
                                    "use tls, or leave drive_gains out"));
}

}  // namespace torquescope
