#include "engine/data/zero_phase.hpp"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include <algorithm>
#include <array>

#include "engine/base/contract.hpp"
#include "kernels/section_cascade.hpp"

namespace torquescope {
namespace {

constexpr auto most_together = static_cast<Eigen::Index>(kernels::most_cascade_signals);
template <Eigen::Index lanes>
using Block = Eigen::Matrix<double, lanes, Eigen::Dynamic>;  // one column per sample

// Numbers below 1e-308 are zero while this lives: a signal that is zero for long leaves a filter full of them, and each
// costs a hundred times as much as another number.
class TinyIsZero {
 public:
#ifdef __SSE2__
  TinyIsZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | flush_to_zero | denormals_are_zero); }
  ~TinyIsZero() { _mm_setcsr(before_); }
  TinyIsZero(TinyIsZero const&) = delete;
  TinyIsZero& operator=(TinyIsZero const&) = delete;

 private:
  static constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
  unsigned before_;
#endif
};

// `width` columns from `from` on, each in its lane; the other lanes repeat the last of them, so that every sample takes
// the same few instructions
template <Eigen::Index lanes>
void load(Eigen::Ref<Eigen::MatrixXd const> const& signals, Eigen::Index from, Eigen::Index width, Eigen::Index pad,
          Block<lanes>& block) {
  std::array<double const*, static_cast<std::size_t>(lanes)> column{};
  for (Eigen::Index k = 0; k < lanes; ++k)
    column[static_cast<std::size_t>(k)] = signals.col(from + std::min(k, width - 1)).data();
  double* out = block.data() + pad * lanes;
  for (Eigen::Index i = 0; i < signals.rows(); ++i, out += lanes)
    for (std::size_t k = 0; k < column.size(); ++k) out[k] = column[k][i];
}

// `width` columns from `from` on, at most `lanes`
template <Eigen::Index lanes>
void filter_block(std::vector<FilterSection> const& sections, Eigen::Ref<Eigen::MatrixXd const> const& signals,
                  KeptSamples const& kept, Eigen::Index from, Eigen::Index width, Eigen::MatrixXd& filtered) {
  Eigen::Index const n = signals.rows(), pad = padding_of(sections);
  Block<lanes> block(lanes, n + 2 * pad);
  load<lanes>(signals, from, width, pad, block);
  for (Eigen::Index i = 1; i <= pad; ++i) {
    block.col(pad - i) = 2 * block.col(pad) - block.col(pad + i);
    block.col(pad + n - 1 + i) = 2 * block.col(pad + n - 1) - block.col(pad + n - 1 - i);
  }
  for (auto const direction : {kernels::CascadeDirection::forwards, kernels::CascadeDirection::backwards})
    kernels::run_cascade(sections.data(), sections.size(), block.data(), static_cast<std::size_t>(block.cols()),
                         static_cast<std::size_t>(lanes), direction);
  for (Eigen::Index i = 0; i < kept.count; ++i)
    filtered.row(i).segment(from, width) = block.col(pad + kept.first + i * kept.step).head(width);
}

// filtered: the signals themselves where every sample is kept, if the caller likes
void filter_columns(std::vector<FilterSection> const& sections, Eigen::Ref<Eigen::MatrixXd const> const& signals,
                    KeptSamples const& kept, Eigen::MatrixXd& filtered) {
  [[maybe_unused]] TinyIsZero const tiny_is_zero;
  [[maybe_unused]] Eigen::Index const n = signals.rows();
  TORQUESCOPE_EXPECT(n > padding_of(sections) && kept.first >= 0 && kept.step >= 1);
  TORQUESCOPE_EXPECT(kept.count == 0 || kept.first + (kept.count - 1) * kept.step < n);
  for (Eigen::Index from = 0; from < signals.cols(); from += most_together) {
    Eigen::Index const width = std::min(most_together, signals.cols() - from);
    auto const filter_them = width <= 2 ? filter_block<2> : width <= 4 ? filter_block<4> : filter_block<most_together>;
    filter_them(sections, signals, kept, from, width, filtered);
  }
}

}  // namespace

Eigen::Index padding_of(std::vector<FilterSection> const& sections) {
  bool const odd = !sections.empty() && sections.back().b2 == 0.0 && sections.back().a2 == 0.0;
  return 3 * (2 * static_cast<Eigen::Index>(sections.size()) + 1 - (odd ? 1 : 0));
}

Eigen::VectorXd zero_phase(std::vector<FilterSection> const& sections,
                           Eigen::Ref<Eigen::VectorXd const> const& signal) {
  return zero_phase_columns(sections, signal);
}

Eigen::MatrixXd zero_phase_columns(std::vector<FilterSection> const& sections,
                                   Eigen::Ref<Eigen::MatrixXd const> const& signals) {
  return zero_phase_columns(sections, signals, {0, signals.rows(), 1});
}

Eigen::MatrixXd zero_phase_columns(std::vector<FilterSection> const& sections,
                                   Eigen::Ref<Eigen::MatrixXd const> const& signals, KeptSamples const& kept) {
  Eigen::MatrixXd filtered(kept.count, signals.cols());
  filter_columns(sections, signals, kept, filtered);
  return filtered;
}

void zero_phase_in_place(std::vector<FilterSection> const& sections, Eigen::MatrixXd& signals) {
  filter_columns(sections, signals, {0, signals.rows(), 1}, signals);
}

}  // namespace torquescope
