#pragma once
// The part that all differential evolutions share: a population, one trial vector per member and generation, one-to-one
// selection, progress, save and restore. A kind of search says how a trial is made and what it learns.
//
// Random     trial of member i in generation t: stream (key, t, i); so ask() is a pure function of the state
// Promise    candidates are inside the bounds; a candidate without finite fitness is counted and never selected
// State      optimiser_state.hpp, and what the kind adds; restore() throws std::invalid_argument, and changes nothing,
//            for another kind, size or key

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/fit/optim/optimiser.hpp"
#include "engine/fit/optim/population.hpp"
#include "engine/fit/optim/trial_vector.hpp"

namespace torquescope {

// one selection: the population on both sides of it, and the members whose trials won, ascending
struct Selected {
  Population const& before;
  Population const& after;
  std::span<std::size_t const> winners;
};

class GenerationalSearch : public Optimiser {
 public:
  GenerationalSearch(std::string kind, Bounds bounds, RandomKey key, std::size_t n_members);

  std::size_t dimension() const final { return bounds_.dimension(); }
  std::size_t batch_size() const final { return population_.size(); }
  std::size_t largest_batch() const final { return n_members_; }
  void start_at(std::span<double const> point) final;
  void ask(MatrixView<double> candidates) const final;
  void tell(MatrixView<double const> asked, std::span<double const> fitness) final;

  Progress const& progress() const final { return progress_; }
  MatrixView<double const> population() const final { return population_.members(); }
  std::span<double const> fitness() const final { return population_.fitness; }

  OptimiserState save() const final;
  void restore(OptimiserState const& state) final;

 protected:
  Bounds const& bounds() const { return bounds_; }

  // one row per member
  virtual void make_trials(TrialStreams const& streams, MatrixView<double> const& trials) const = 0;
  // after selection: writes F, CR, PC, FC of the generation just told where the kind has them, and adapts
  virtual void learn(Selected const& step, Progress& progress) = 0;
  // after learn(): members that go on, the best of them; and the least that there ever are
  virtual std::size_t members_to_keep() const { return population_.size(); }
  virtual std::size_t least_members() const { return n_members_; }
  virtual void save_more(OptimiserState&) const {}
  // checks all its entries before it changes anything
  virtual void restore_more(OptimiserState const&) {}

 private:
  bool begun() const { return progress_.evaluations > 0; }
  void fill_first_batch(MatrixView<double> members) const;
  void keep_initial_population(MatrixView<double const> asked, std::span<double const> fitness);
  void select_and_learn(MatrixView<double const> asked, std::span<double const> fitness);
  void forget_generation_before();

  std::string kind_;
  Bounds bounds_;
  RandomKey key_;
  std::size_t n_members_;      // in the beginning
  std::vector<double> start_;  // of the first member; empty: as the others
  Population population_;
  Population before_;                 // the generation before: differs from population_ in the winners
  std::vector<std::size_t> winners_;  // of the last generation
  Progress progress_;
};

}  // namespace torquescope
