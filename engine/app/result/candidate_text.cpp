#include "engine/app/result/candidate_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"
#include "engine/base/quantity_text.hpp"

namespace torquescope {

namespace {

bool is_tested(Candidate const& one) { return one.decision != Decision::not_tested; }
bool is_taken(Candidate const& one) { return is_tested(one) && one.decision != Decision::rejected; }

// by columns that are shown: what was taken, then the smallest p that counts, equal ones by z; as the page
// (scripts/report/torquescope/page/tables_of_diagnosis.py)
std::vector<Candidate const*> in_order(JointDiagnosis const& joint) {
  double const least = least_p(joint.replicates);
  auto const rank = [least](Candidate const& one) {
    double const p = std::isfinite(one.p) ? std::max(one.p, least) : 2.0;
    double const z = std::isfinite(one.z) ? one.z : std::numeric_limits<double>::lowest();
    return std::tuple(is_taken(one) ? 0 : is_tested(one) ? 1 : 2, p, -z);
  };
  std::vector<Candidate const*> ordered;
  for (auto const& one : joint.candidates) ordered.push_back(&one);
  std::stable_sort(ordered.begin(), ordered.end(), [&](auto const* a, auto const* b) { return rank(*a) < rank(*b); });
  return ordered;
}

// distinct reasons against a name, in the order in which the table comes to them
std::vector<std::string> reasons_of(std::vector<Candidate const*> const& shown, Decision decision) {
  std::vector<std::string> reasons;
  for (auto const* one : shown)
    if (one->decision == decision && !one->reason.empty() &&
        std::find(reasons.begin(), reasons.end(), one->reason) == reasons.end())
      reasons.push_back(one->reason);
  return reasons;
}

std::string decision_cell(Candidate const& one, std::vector<std::string> const& reasons) {
  if (one.decision != Decision::rejected || one.reason.empty()) return word(one.decision);
  auto const at = std::find(reasons.begin(), reasons.end(), one.reason) - reasons.begin();
  return fmt::format("{} ({})", word(one.decision), at + 1);
}

bool is_cross_validated(Candidate const* one) { return std::isfinite(one->cv_gain); }

std::string table_of(JointDiagnosis const& joint, std::vector<Candidate const*> const& shown, bool with_family) {
  using Align = TextTable::Align;
  double const least = least_p(joint.replicates);
  std::vector<Align> columns{Align::left, Align::left, Align::right, Align::right, Align::right, Align::left};
  bool const with_cv = std::any_of(shown.begin(), shown.end(), is_cross_validated);
  constexpr std::ptrdiff_t of_family = 1, of_cv = 4;
  if (!with_cv) columns.erase(columns.begin() + of_cv);
  if (!with_family) columns.erase(columns.begin() + of_family);
  TextTable table(columns, std::string(lead_columns, ' '));
  auto const row = [&](std::vector<std::string> cells) {
    if (!with_cv) cells.erase(cells.begin() + of_cv);
    if (!with_family) cells.erase(cells.begin() + of_family);
    table.row(std::move(cells));
  };
  auto const reasons = reasons_of(shown, Decision::rejected);
  row({"effect", "family", "z", "p", "CV gain", ""});
  for (auto const* one : shown) {
    bool const tested = is_tested(*one);
    row({printable(one->name), printable(one->family),
         tested && std::isfinite(one->z) ? fmt::format("{:.1f}", one->z) : "", tested ? p_cell(one->p, least) : "",
         cv_gain_cell(one->cv_gain), decision_cell(*one, reasons)});
  }
  // wide enough for any cell: what is too long for the page is decided by the caller, not by wrapping
  return table.text(4 * page_width());
}

bool fits_page(std::string const& text) {
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t const end = std::min(text.find('\n', begin), text.size());
    if (columns_of(text.substr(begin, end - begin)) > page_width()) return false;
    begin = end + 1;
  }
  return true;
}

std::string why_text(std::vector<Candidate const*> const& shown) {
  std::vector<std::string> lines;
  auto const rejected = reasons_of(shown, Decision::rejected);
  for (std::size_t i = 0; i < rejected.size(); ++i)
    lines.push_back(fmt::format("({}) {}", i + 1, printable(rejected[i])));
  for (auto const& reason : reasons_of(shown, Decision::not_tested))
    lines.push_back("not tested: " + printable(reason));
  auto const tried = std::count_if(shown.begin(), shown.end(), is_cross_validated);
  if (tried > 0)
    lines.push_back(std::string("CV gain: share of the mismatch predicted on blocks it was not fitted to") +
                    (tried < std::ssize(shown) ? "; blank: not tried" : ""));
  std::string text;
  for (auto const& line : lines) text += hanging(lead(text.empty() ? "why" : ""), line);
  return text;
}

}  // namespace

std::string cv_gain_cell(double share) {
  if (!std::isfinite(share)) return "";
  if (share > 1.0) return "> 100 %";
  return share > 0.0 ? fmt::format("{:.1f} %", 100.0 * share) : "none";
}

std::string candidates_text(JointDiagnosis const& joint) {
  if (joint.candidates.empty()) return "";
  auto const shown = in_order(joint);
  std::string text = table_of(joint, shown, true);
  if (!fits_page(text)) text = table_of(joint, shown, false);
  return lead("what") + text.substr(lead_columns) + why_text(shown);
}

}  // namespace torquescope
