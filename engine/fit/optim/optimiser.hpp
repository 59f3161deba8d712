#pragma once
// A population search as ask / tell: ask() fills a batch of candidates, the caller evaluates them, tell() learns.
//
// The first batch is the initial population; each later batch is one generation's trial vectors. An optimiser is only
// mathematics: it owns no thread, clock, file, log or seed source; its random numbers are addressed by
// (key, generation, member), so a restored optimiser goes on as if never interrupted.
//
// Errors     std::invalid_argument in restore() for a state of another kind; sizes are contracts
// Threads    one object, one thread at a time

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/matrix_view.hpp"
#include "engine/base/options.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/fit/optim/objective.hpp"

namespace torquescope {

class FuzzyController;

// what a search has reached after tell(); everything the result file stores per generation
struct Progress {
  std::int64_t generation = 0;        // 0: the initial population
  std::int64_t evaluations = 0;       // candidates told so far
  std::int64_t nonfinite = 0;         // of these, how many had NaN or inf fitness
  std::int64_t last_improvement = 0;  // generation in which best_fitness last fell: stagnation counts from here
  double best_fitness = 0.0;          // +inf while no candidate had finite fitness
  std::vector<double> best;           // dimension; NaN while no candidate had finite fitness
  // of the generation just told; NaN where an optimiser has no such number (the initial population, other methods)
  double F = 0.0;   // mutation factor
  double CR = 0.0;  // crossover rate
  double PC = 0.0;  // parameter change, FADE eq. 8 (raw or relative as the optimiser is set)
  double FC = 0.0;  // function value change, FADE eq. 8
};

// state of a search as named lists of numbers: enough to go on exactly
using OptimiserState = std::map<std::string, std::vector<double>>;

class Optimiser {
 public:
  virtual ~Optimiser() = default;

  virtual std::size_t dimension() const = 0;
  // members of the next batch
  virtual std::size_t batch_size() const = 0;
  // members of the largest batch, and of the largest population, from beginning to end: what is stored has room for
  // them. More than batch_size() only where a population shrinks
  virtual std::size_t largest_batch() const { return batch_size(); }
  // before the first ask(): where the search begins, moved into the box; NaN where that is not known. The first member
  // of a population, the mean of a distribution
  virtual void start_at(std::span<double const> point) = 0;
  // fills batch_size() rows; calling it twice without tell() gives the same rows
  virtual void ask(MatrixView<double> candidates) const = 0;
  // `asked` may hold fewer rows than batch_size() when an evaluation budget cut the batch: the first rows count
  virtual void tell(MatrixView<double const> asked, std::span<double const> fitness) = 0;

  // what it does follows from the limits on generations and evaluations: with others it would have gone another way
  virtual bool plans_by_budget() const { return false; }

  virtual Progress const& progress() const = 0;
  // current population after selection: members x dimension, and its fitness (+inf where there was no finite one).
  // Methods that keep a distribution rather than members: the candidates told last
  virtual MatrixView<double const> population() const = 0;
  virtual std::span<double const> fitness() const = 0;

  virtual OptimiserState save() const = 0;
  virtual void restore(OptimiserState const& state) = 0;
};

// how one kind of optimiser is made, checked and described; one per file in optimisers/
struct OptimiserChoice {
  std::string name;    // "fade"
  std::string title;   // "Fuzzy Adaptive DE"
  std::string source;  // paper
  // every option with its default; what `describe fade` prints
  std::vector<OptionDescription> options;
  // reads the options of an [[estimator]] section ("name" and other callers' keys in `ignored`), appending problems;
  // the returned function makes the optimiser of one run and never throws on checked options
  std::function<std::function<std::unique_ptr<Optimiser>(Bounds const&, RandomKey)>(
      Section const&, std::vector<std::string> const& ignored, std::vector<Problem>&)>
      prepare;
  // members of a population under these options: sizes of the result file (after prepare found no problem)
  std::function<std::size_t(Section const&, std::size_t dimension)> population_size;
  // the fuzzy controller that these options make, to draw it; empty for methods without one
  std::function<std::shared_ptr<FuzzyController const>(Section const&)> controller{};
};

// every optimiser that CMakeLists.txt lists, in that order
std::vector<OptimiserChoice> const& optimiser_choices();
// nullptr when there is none of this name
OptimiserChoice const* find_optimiser(std::string const& name);

}  // namespace torquescope
