#pragma once
// One start of an evolution strategy in a box: batches sampled from a distribution that learns from several together.
//
// Units      each parameter as a place in the box, 0 .. 1: one step size fits all
// Bounds     samples are mirrored, and the distribution learns from the mirrored ones: an image beyond a bound would
//            be a second minimum. Resampling needs 2^R samples near a corner; a penalty changes the order of fitness
// Worse half teaches in generations without mirrored samples alone: at a corner it would keep the step size large
// End        the start is stuck (start_history.hpp), or its distribution has collapsed
// Random     sample of member i in generation t: stream (key, t, i)
// Source     Hansen: The CMA evolution strategy: a tutorial, arXiv 1604.00772 (2016)

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/fit/optim/covariance_adaptation.hpp"
#include "engine/fit/optim/optimiser.hpp"
#include "engine/fit/optim/start_history.hpp"

namespace torquescope {

// samples of a generation, as the source recommends
std::size_t usual_samples(std::size_t dimension);
// uniform in the box: many boxes are symmetric about what is sought. The last stream of the generation
Eigen::VectorXd uniform_place(RandomKey key, std::int64_t generation, std::size_t dimension);
// as a place in the box; where it is not known, as in `otherwise`
Eigen::VectorXd place_of(std::span<double const> point, Bounds const& bounds, Eigen::VectorXd otherwise);

// samples that teach the covariance
enum class Teaching { better_half, both_halves };

struct CovarianceStartSettings {
  std::size_t batch_size;
  std::size_t batches;  // that a generation of the distribution has
  double sigma;
  Teaching teaching = Teaching::better_half;
};

class CovarianceStart {
 public:
  CovarianceStart(RandomKey key, Eigen::VectorXd mean, CovarianceStartSettings const& settings);

  void ask(std::int64_t generation, Bounds const& bounds, MatrixView<double> const& candidates) const;
  // a whole batch, +inf where there is no finite fitness; true: another start promises more
  bool is_over_after(std::int64_t generation, std::span<double const> fitness);
  // no batch waits for others of its generation
  bool has_learned_all() const { return told_.empty(); }
  // an evaluation budget ended with a cut batch: the distribution learns nothing
  void cut() { told_.clear(); }

  void save(OptimiserState& state) const;
  // checks all its entries before it changes anything
  void restore(OptimiserState const& state);

 private:
  Eigen::VectorXd deviates(std::int64_t generation, std::size_t member) const;
  void learn(std::int64_t generation);

  RandomKey key_;
  CovarianceStartSettings settings_;
  CovarianceAdaptation distribution_;
  StartHistory history_;
  std::vector<double> told_;  // fitness of the batches from which the distribution has still to learn
};

}  // namespace torquescope
