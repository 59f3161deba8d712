#include "engine/data/health/sentinels.hpp"

#include "engine/data/health/far_values.hpp"

namespace torquescope {
namespace {

void take_out(Examination& exam, std::string const& channel, std::vector<FarValue> const& found) {
  for (auto const& far : found) {
    for (std::size_t row : far.rows) exam.values(channel)[row] = missing;
    exam.add(FindingKind::sentinel, Grade::warning, Repair::filled, channel, far.rows, far.value);
  }
}

}  // namespace

void examine_values_outside(Examination& exam) {
  for (auto const* name : {"position", "torque", "reference", "velocity", "acceleration"})
    if (exam.has(name)) take_out(exam, name, values_outside(exam.values(name)));
}

void examine_values_inside(Examination& exam, std::string const& channel) {
  if (exam.has(channel)) take_out(exam, channel, values_inside(exam.values(channel)));
}

}  // namespace torquescope
