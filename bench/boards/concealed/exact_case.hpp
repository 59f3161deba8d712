#pragma once
// A drawn case whose plant is exact, with its report.
//
// Exact      half the step changes nothing to speak of (StepError::is_exact). A load that bounces in a gap can be
//            chaotic: then no step is fine enough (an eighth of the step left a sixth of the noise floor where the step
//            itself left a third), and what is recorded is one compiler's last bits
// Method     the same name is drawn anew with another salt, up to most_plant_draws times; the first draw has none.
//            If none is exact the last is given, and the scorer leaves it out (judge.py)
// Same name  same case; Case::plant_draws says which draw it is

#include "concealed/case_report.hpp"
#include "concealed/drawn_name.hpp"

namespace concealed {

inline constexpr int most_plant_draws = 5;

struct ReportedCase {
  Case one_case;
  CaseReport report;
};

ReportedCase exact_case(DrawnName const& name);

}  // namespace concealed
