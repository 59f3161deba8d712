#include "engine/infer/decision/servo_verdict.hpp"

#include <algorithm>

namespace torquescope {

Verdict servo_verdict(LoopFacts const& facts, ServoFit const& fit) {
  if (!facts.decides()) return Verdict::insufficient;
  if (facts.kept.empty()) return fit.is_adequate() ? Verdict::none : Verdict::unexplained;
  if (!fit.is_adequate()) return Verdict::partly;
  bool const all_alone =
      std::all_of(facts.kept.begin(), facts.kept.end(), [](KeptMove const& move) { return move.rivals.empty(); });
  return all_alone ? Verdict::named : Verdict::one_of_class;
}

}  // namespace torquescope
