#include "engine/infer/pipeline/reversal_rows.hpp"

#include "engine/base/contract.hpp"

namespace torquescope {

std::vector<std::string> reversal_words() { return {"mask", "weigh", "both"}; }

ReversalRows reversals_of(std::string const& word) {
  TORQUESCOPE_EXPECT(word == "mask" || word == "weigh" || word == "both");
  if (word == "both") return ReversalRows::both;
  return word == "weigh" ? ReversalRows::weigh : ReversalRows::mask;
}

}  // namespace torquescope
