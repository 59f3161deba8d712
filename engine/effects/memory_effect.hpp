#pragma once
// An effect whose columns depend on the past: it runs a state over the motion, for identification and simulation alike.
// Files in effects/ add the state, a plain class:
//
//   void start(JointState const& state)
//   void advance(JointState const& state, double step_s)                     step_s > 0
//   std::array<double, L> row(JointState const& state) const                 torque per unit of each linear parameter
// Optional, for a memory that fades by an exponential (lanes then compute all of theirs at once):
//   double decay_exponent(JointState const& state) const                     until this state
//   void advance(JointState const& state, double step_s, double decay)       decay = exp of it; replaces the other one
//
// Row        of the state last advanced to; a simulator may vary velocity and acceleration there, not place or time
// Lanes      replicates of a group go side by side, each with its own state; the class is looked up once for all
// Threads    an EffectMemory is used by one thread

#include <array>
#include <utility>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/effects/effect.hpp"
#include "engine/effects/joint_states.hpp"

namespace torquescope {

// the states behind the columns of one effect, one per lane: of one shape for twins, of one shape each for columns
class EffectMemory {
 public:
  virtual ~EffectMemory() = default;
  // `other`, of the same effect and one lane as this, becomes the lane after the last
  virtual void append(EffectMemory const& other) = 0;
  // of lanes that start with the motion; out: input.size() x linear parameters of each lane.
  // A state waits for itself from sample to sample, so that several take hardly longer than one
  virtual void columns(EffectInput const& input, Eigen::Ref<Eigen::MatrixXd> out) = 0;
  // the lanes have come to `at`; they start with the first call
  virtual void advance(JointStates const& at, double step_s) = 0;
  virtual void torques(JointStates const& at, std::span<double const> linear, std::span<double> out) const = 0;
};

class MemoryEffect : public Effect {
 public:
  using Effect::Effect;
  bool has_memory() const final { return true; }
  void columns(EffectInput const& input, std::span<double const> shape, Eigen::Ref<Eigen::MatrixXd> out) const override;
  void columns_of_shapes(EffectInput const& input, std::vector<std::vector<double>> const& shapes,
                         Eigen::Ref<Eigen::MatrixXd> out) const override;
  std::unique_ptr<EffectRunner> runner(std::span<double const> parameters, JointScales const& scales) const override;
  // of several joints with one shape
  virtual std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales,
                                               std::size_t lanes) const = 0;
};

// what a file in effects/ returns as memory(): `lanes` copies of a state that has not started
template <typename State>
std::unique_ptr<EffectMemory> memory_of(State const& fresh, std::size_t lanes) {
  constexpr bool decays = requires(State state, JointState at) { state.decay_exponent(at); };
  class Lanes final : public EffectMemory {
   public:
    Lanes(State const& fresh, std::size_t lanes) : states_(lanes, fresh) {}

    void append(EffectMemory const& other) override {
      auto const& added = static_cast<Lanes const&>(other).states_;
      states_.insert(states_.end(), added.begin(), added.end());
    }

    void columns(EffectInput const& input, Eigen::Ref<Eigen::MatrixXd> out) override {
      if constexpr (decays) decays_.resize(states_.size());
      for (Eigen::Index i = 0; i < input.size(); ++i) {
        JointState const now = input.state(i);
        double const step_s = i == 0 ? 0.0 : input.motion.time_s[i] - input.motion.time_s[i - 1];
        Eigen::Index column = 0;
        if (i > 0) {
          for (std::size_t lane = 0; lane < states_.size(); ++lane) look_ahead(lane, now);
          fade();
        }
        for (std::size_t lane = 0; lane < states_.size(); ++lane) {
          if (i == 0)
            states_[lane].start(now);
          else
            go_on(lane, now, step_s);
          for (double const value : states_[lane].row(now)) out(i, column++) = value;
        }
      }
    }

    void advance(JointStates const& at, double step_s) override {
      if (!std::exchange(has_started_, true)) {
        if constexpr (decays) decays_.resize(states_.size());
        for (std::size_t lane = 0; lane < states_.size(); ++lane) states_[lane].start(at.state(lane));
        return;
      }
      for (std::size_t lane = 0; lane < states_.size(); ++lane) look_ahead(lane, at.state(lane));
      fade();
      for (std::size_t lane = 0; lane < states_.size(); ++lane) go_on(lane, at.state(lane), step_s);
    }

    void torques(JointStates const& at, std::span<double const> linear, std::span<double> out) const override {
      using Row = decltype(states_.front().row(JointState{}));
      constexpr std::size_t width = std::tuple_size_v<Row>;
      TORQUESCOPE_EXPECT(linear.size() == width && out.size() == states_.size());
      for (std::size_t lane = 0; lane < states_.size(); ++lane) {
        Row const row = states_[lane].row(at.state(lane));
        double sum = 0.0;
        for (std::size_t k = 0; k < width; ++k) sum += linear[k] * row[k];
        out[lane] = sum;
      }
    }

   private:
    // of all lanes, then fade(), then go_on() of all lanes
    void look_ahead([[maybe_unused]] std::size_t lane, [[maybe_unused]] JointState const& to) {
      if constexpr (decays) decays_[lane] = states_[lane].decay_exponent(to);
    }

    void fade() {
      if constexpr (decays) kernels::exponential(decays_.data(), decays_.size(), decays_.data());
    }

    void go_on(std::size_t lane, JointState const& to, double step_s) {
      if constexpr (decays)
        states_[lane].advance(to, step_s, decays_[lane]);
      else
        states_[lane].advance(to, step_s);
    }

    std::vector<State> states_;
    std::vector<double> decays_;  // of each lane, in the coming step
    bool has_started_ = false;
  };
  return std::make_unique<Lanes>(fresh, lanes);
}

}  // namespace torquescope
