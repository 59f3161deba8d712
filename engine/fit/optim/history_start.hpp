#pragma once
// One start of a differential evolution with a history of successes, in batches smaller than its population.
//
// Equation   trials as JADE's (current_to_pbest.hpp), F and CR from a history of successes (success_history.hpp)
// Sweep      the first batches are the members, uniform in the box; then each batch has the trials of the next members
//            and the history learns from every batch. When all members have had theirs, the movement is measured
// End        the population is stuck over sweeps (start_history.hpp), or narrower than 1e-12 of the box
// Random     row i in generation t: stream (key, t, i) of a first member, (key, t, its member) of a trial; who leaves
//            the archive: the last stream but two of t
// Source     Tanabe, Fukunaga 2014, CEC, doi:10.1109/CEC.2014.6900380, without its shrinking population

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/fit/optim/member_archive.hpp"
#include "engine/fit/optim/movement.hpp"
#include "engine/fit/optim/optimiser.hpp"
#include "engine/fit/optim/population.hpp"
#include "engine/fit/optim/start_history.hpp"
#include "engine/fit/optim/success_history.hpp"

namespace torquescope {

struct HistoryStartSettings {
  std::size_t batch_size;
  std::size_t batches;  // that the population has
  double best_share;
  BoundRepair repair;
};

class HistoryStart {
 public:
  HistoryStart(RandomKey key, std::size_t dimension, HistoryStartSettings const& settings);

  void ask(std::int64_t generation, Bounds const& bounds, MatrixView<double> const& candidates) const;
  // a whole batch; F and CR of `progress` become the means of its trials, PC and FC those of a sweep that ends here.
  // true: another start promises more
  bool is_over_after(std::int64_t generation, MatrixView<double const> asked, std::span<double const> fitness,
                     Bounds const& bounds, Progress& progress);

  bool is_empty() const { return n_members_ == 0; }
  // no member waits for its trial
  bool has_swept() const { return !is_filling() && next_ == 0; }

  void save(OptimiserState& state) const;
  // checks all its entries before it changes anything
  void restore(OptimiserState const& state);

 private:
  bool is_filling() const { return n_members_ < members_.size(); }
  TrialControls controls_of(std::int64_t generation, std::size_t member) const;
  void record_controls(std::int64_t generation, Progress& progress) const;
  void select_and_learn(std::int64_t generation, MatrixView<double const> asked, std::span<double const> fitness);

  RandomKey key_;
  HistoryStartSettings settings_;
  Population members_;
  Population before_;          // when the sweep began
  std::size_t n_members_ = 0;  // so far
  std::size_t next_ = 0;       // target of the coming batch's first trial
  SuccessHistory history_;
  MemberArchive archive_;
  StartHistory sweeps_;
};

}  // namespace torquescope
