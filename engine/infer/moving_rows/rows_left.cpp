#include "engine/infer/moving_rows/rows_left.hpp"

#include <algorithm>

#include "engine/fit/statistics/held_out_gain.hpp"

namespace torquescope {
namespace {

std::vector<HeldOutBlock> paired_blocks(RowsLeft const& before, RowsLeft const& after) {
  std::vector<HeldOutBlock> paired;
  for (std::size_t i = 0; i < before.parts.size(); ++i) {
    auto const blocks = held_out_blocks(before.parts[i].left, after.parts[i].left,
                                        std::max<Eigen::Index>(1, before.parts[i].memory_rows));
    paired.insert(paired.end(), blocks.begin(), blocks.end());
  }
  return paired;
}

}  // namespace

double RowsLeft::energy() const {
  double sum = 0.0;
  for (Part const& part : parts) sum += part.left.squaredNorm();
  return sum;
}

bool leaves_clearly_more(RowsLeft const& one, RowsLeft const& best, OfForm const& form) {
  double const explained = std::max(0.0, form.without_any.energy() - best.energy());
  bool const is_beyond_form = one.energy() - best.energy() > form.tolerance * form.tolerance * explained;
  return is_beyond_form &&
         held_out_gain(paired_blocks(one, best), Blocks::where_it_acts).change == HeldOutChange::lower;
}

bool leaves_clearly_less(RowsLeft const& other, RowsLeft const& one) {
  return held_out_gain(paired_blocks(one, other)).change == HeldOutChange::lower;
}

}  // namespace torquescope
