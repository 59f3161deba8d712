#pragma once
// The verdict as a table of facts: nothing else decides.
//
// Rows       baseline adequate | laws kept | adequate with them | held-out error clearly lower | explain most of it
//            yes | none | -   | -   | -   -> none (what the motion cannot tell: insufficient)
//            no  | none | -   | -   | -   -> unexplained (no relation with the motion at all: data fault)
//            -   | some | yes | yes | -   -> named, one of a class, or a data fault when all act on a channel; none
//                                           where the error falls by less than DecisionLevels::least_fall
//            -   | some | no  | yes | yes -> partly explained
//            -   | some | no  | yes | no  -> unexplained
//            no  | some | -   | no  | -   -> unexplained
//            yes | some | -   | no  | -   -> as without laws
// Before     where the baseline is not adequate and the motion of other joints predicts held-out rows better than the
//            laws do: unexplained
// Threads    pure functions
// Source     engine/infer/moving_rows/THEORY.md, Verdict

#include <cstddef>
#include <string>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct VerdictFacts {
  bool is_baseline_adequate = false;   // in training and unseen
  std::size_t laws = 0;                // of the last model of the search
  bool is_adequate = false;            // that model, in training and unseen
  bool is_held_out_lower = false;      // its held-out error: clearly
  bool is_worth_naming = true;         // it falls by as much as a verdict names
  bool explains_most = false;          // of the mismatch on held-out rows, more than it leaves
  bool has_class = false;              // some law cannot be told from others
  bool all_on_channel = false;         // all laws, and all that they cannot be told from, are faults of a channel
  bool is_motion_poor = false;         // the motion could not have shown what is looked for
  bool others_predict_better = false;  // other joints' motion than all laws, and clearly than none
  bool has_relation = true;            // the model, or some law beyond chance, has something of the torque
};

enum class VerdictReason {
  nothing_left,     // the model is adequate
  motion_poor,      // nothing is left, and the motion could not have shown much
  nothing_fits,     // something is left, and no law of the catalogue predicts it
  no_relation,      // the torque has nothing to do with the motion
  other_joints,     // what is left goes with the motion of other joints
  not_held_out,     // laws fit the training rows and do not predict others better
  too_small,        // laws make the model adequate, and the error hardly falls by them
  most_is_left,     // laws predict better and leave more than they explain
  explained,        // laws make the model adequate
  partly_explained  // laws explain most of it, and the rest has a structure of its own
};
std::string word(VerdictReason reason);  // "nothing_left"

struct VerdictOf {
  Verdict verdict = Verdict::none;
  VerdictReason reason = VerdictReason::nothing_left;
  bool keeps_names = false;
};

VerdictOf verdict_of(VerdictFacts const& facts);

}  // namespace torquescope
