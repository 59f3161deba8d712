#include "engine/app/phase_times.hpp"

#include <algorithm>
#include <utility>

namespace torquescope {

PhaseTimes::PhaseTimes(Clock clock) : clock_(std::move(clock)), began_(clock_()) {
  current_.stage = "prepare";
  current_.counted = "";
}

void PhaseTimes::note(ProgressUpdate const& update) {
  bool const begins_again = update.runs_done < current_.runs_done;
  if (update.stage != current_.stage || begins_again) close();
  current_ = update;
}

std::vector<ProgressUpdate> PhaseTimes::finish() {
  close();
  return totals_;
}

void PhaseTimes::close() {
  double const now = clock_();
  current_.seconds = now - std::exchange(began_, now);
  auto const known = std::find_if(totals_.begin(), totals_.end(),
                                  [this](ProgressUpdate const& total) { return total.stage == current_.stage; });
  if (known == totals_.end()) {
    totals_.push_back(current_);
  } else {
    known->runs_done += current_.runs_done;
    known->seconds += current_.seconds;
  }
  current_.runs_done = 0;
}

}  // namespace torquescope
