#include <cmath>
#include <numbers>

#include "engine/base/contract.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/motion.hpp"
#include "engine/data/zero_phase.hpp"

namespace torquescope {

struct ParallelFilter::State {
  std::vector<FilterSection> sections{};  // empty: no low-pass
  Eigen::Index n_samples = 0;
  Eigen::Index edge = 0;
  Eigen::Index factor = 1;
  Eigen::Index kept = 0;
  double rate_hz = 0.0;  // of what is kept
  double cutoff_hz = 0.0;
  int order = 0;
};

ParallelFilter::ParallelFilter() : state_(std::make_unique<State>()) {}

ParallelFilter::ParallelFilter(FilterOptions const& options, double rate_hz, Eigen::Index n_samples,
                               Section const& section)
    : state_(std::make_unique<State>()) {
  double const cutoff_hz = parallel_cutoff_of(options);
  state_->factor = decimation_factor(options, rate_hz, section);
  check_cutoff("parallel_cutoff_hz", cutoff_hz, rate_hz, section);
  check_length(options, n_samples, rate_hz);
  state_->cutoff_hz = cutoff_hz;
  state_->order = static_cast<int>(options.order);
  if (cutoff_hz > 0) state_->sections = butterworth_lowpass(state_->order, cutoff_hz, rate_hz);
  state_->n_samples = n_samples;
  state_->edge = edge_samples(options, rate_hz);
  state_->kept = (n_samples - 2 * state_->edge + state_->factor - 1) / state_->factor;
  state_->rate_hz = rate_hz / static_cast<double>(state_->factor);
}

ParallelFilter::~ParallelFilter() = default;
ParallelFilter::ParallelFilter(ParallelFilter&&) noexcept = default;

Eigen::Index ParallelFilter::kept_samples() const { return state_->kept; }

double ParallelFilter::kept_rate_hz() const { return state_->rate_hz; }

bool ParallelFilter::keeps_everything() const {
  return state_->sections.empty() && state_->factor == 1 && state_->edge == 0;
}

Eigen::VectorXd ParallelFilter::apply(Eigen::Ref<Eigen::VectorXd const> const& signal) const {
  TORQUESCOPE_EXPECT(signal.size() == state_->n_samples);
  return state_->sections.empty() ? pick(signal) : apply_columns(signal).col(0);
}

Eigen::MatrixXd ParallelFilter::apply_columns(Eigen::Ref<Eigen::MatrixXd const> const& signals) const {
  TORQUESCOPE_EXPECT(signals.rows() == state_->n_samples);
  if (state_->sections.empty()) return signals(Eigen::seqN(state_->edge, state_->kept, state_->factor), Eigen::all);
  return zero_phase_columns(state_->sections, signals, {state_->edge, state_->kept, state_->factor});
}

Eigen::Index ParallelFilter::decimation() const { return state_->factor; }

double ParallelFilter::neighbour_correlation(Eigen::Index apart) const {
  if (state_->sections.empty()) return 0.0;
  double const rate_hz = state_->rate_hz * static_cast<double>(state_->factor);
  auto const warped = [&](double frequency_hz) { return std::tan(std::numbers::pi * frequency_hz / rate_hz); };
  // gain of a Butterworth filter that runs forwards and backwards, squared: the spectrum of what passes it
  constexpr int frequencies = 4096;
  double power = 0.0, with_next = 0.0;
  for (int k = 0; k < frequencies; ++k) {
    double const hz = rate_hz * (k + 0.5) / (2.0 * frequencies);
    double const gain = 1.0 / (1.0 + std::pow(warped(hz) / warped(state_->cutoff_hz), 2 * state_->order));
    power += gain * gain;
    with_next += gain * gain * std::cos(2.0 * std::numbers::pi * static_cast<double>(apart) * hz / state_->rate_hz);
  }
  return with_next / power;
}

Eigen::Index ParallelFilter::first_of(Eigen::Index step) const { return state_->edge % step; }

ParallelFilter ParallelFilter::of_every(Eigen::Index step) const {
  TORQUESCOPE_EXPECT(step > 0 && state_->factor % step == 0);
  Eigen::Index const first = first_of(step);
  ParallelFilter result;
  State& own = *result.state_ = *state_;
  own.n_samples = (state_->n_samples - first + step - 1) / step;
  own.edge = (state_->edge - first) / step;
  own.factor = state_->factor / step;
  double const rate_hz = state_->rate_hz * static_cast<double>(own.factor);
  if (!own.sections.empty()) own.sections = butterworth_lowpass(own.order, own.cutoff_hz, rate_hz);
  return result;
}

Eigen::VectorXd ParallelFilter::pick(Eigen::Ref<Eigen::VectorXd const> const& signal) const {
  TORQUESCOPE_EXPECT(signal.size() == state_->n_samples);
  return signal(Eigen::seqN(state_->edge, state_->kept, state_->factor));
}

}  // namespace torquescope
