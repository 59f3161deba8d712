#include "concealed/exact_case.hpp"

#include "concealed/drawn_case.hpp"

namespace concealed {

ReportedCase exact_case(DrawnName const& name) {
  ReportedCase made;
  for (int draws = 1; draws <= most_plant_draws; ++draws) {
    made.one_case = drawn_case(name, draws - 1);
    made.one_case.plant_draws = draws;
    made.report = report_case(made.one_case);
    if (made.report.step_error.is_exact()) break;
  }
  return made;
}

}  // namespace concealed
