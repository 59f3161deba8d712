#include "engine/account/part_explained.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/account/name_list.hpp"
#include "engine/account/sentences.hpp"
#include "engine/base/quantity_text.hpp"

namespace torquescope {

namespace {

// of the map with the accepted effects in the model
std::string rest_clause(JointDiagnosis const& joint) {
  std::string const where = joint.unexplained.empty() ? "" : place_phrase(joint, joint.unexplained.front().where);
  if (where.empty()) return "the map shows no place where the rest stands out";
  UnexplainedPart const& part = joint.unexplained.front();
  std::string const share = std::isfinite(part.energy_share)
                                ? fmt::format(" ({} of the residual's energy)", percent_text(part.energy_share))
                                : "";
  return fmt::format("what is left stands out {}{}", where, share);
}

}  // namespace

std::string part_explained_clause(JointDiagnosis const& joint) {
  auto const names = names_of(joint);
  std::string const share = share_text(joint.explained_share);
  return fmt::format("{} {} {} of what is missing on held-out rows; {}", name_list(names, "and"),
                     names.size() == 1 ? "explains" : "explain", share.empty() ? "a part" : share, rest_clause(joint));
}

}  // namespace torquescope
