#pragma once
// Options of a diagnosis: the job's [diagnose] section, and the effects it looks for.
//
// Errors     problems are appended (78): unknown or repeated effects, an angle's effect on a slide, "all" beside names

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/effects/effect.hpp"

namespace torquescope {

struct DiagnoseOptions {
  std::vector<std::string> effects{"all"};
  std::int64_t replicates = 200;
  double q = 0.05;
  std::int64_t max_effects = 5;
  double delta = 0.0025;
  double tolerance = 0.1;
  double least_fall = 0.05;

  static OptionTable<DiagnoseOptions> const& table();
};

// the effects to look for: those named, in that order, or the whole catalogue as far as the joint can have it, without
// the terms that the model has already. `section`: [diagnose], for the places in messages
// effects of several joints exist in arms alone
enum class JointsOfJob { one, of_an_arm };

std::vector<Effect const*> chosen_effects(DiagnoseOptions const& options, JointKind joint,
                                          std::vector<std::string> const& model_terms, Section const& section,
                                          std::vector<Problem>& problems, JointsOfJob joints = JointsOfJob::one);

}  // namespace torquescope
