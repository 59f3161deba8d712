// The Butterworth design and its zero-phase use: effects first, then numbers of scipy 1.10. Columns side by side
// are what each is alone, and long silence costs nothing.

#include "engine/data/zero_phase.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstring>
#include <limits>
#include <numbers>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace zero_phase_test {

constexpr double pi = std::numbers::pi;

std::complex<double> response(std::vector<FilterSection> const& sections, double frequency_hz, double rate_hz) {
  auto const z = std::polar(1.0, -2 * pi * frequency_hz / rate_hz);  // one sample of delay
  std::complex<double> h = 1.0;
  for (auto const& s : sections) h *= (s.b0 + s.b1 * z + s.b2 * z * z) / (1.0 + s.a1 * z + s.a2 * z * z);
  return h;
}

struct Design {
  int order;
  double cutoff_hz, rate_hz;
};

class ButterworthLowpass : public testing::TestWithParam<Design> {};

TEST_P(ButterworthLowpass, GainFollowsTheAnalyticFormula) {
  auto const [order, cutoff, rate] = GetParam();
  auto const sections = butterworth_lowpass(order, cutoff, rate);
  for (double share : {0.0, 0.01, 0.1, 0.5, 0.9, 1.0, 1.1, 1.5}) {
    double const frequency = share * cutoff;
    if (frequency >= rate / 2) continue;
    double const warped = std::tan(pi * frequency / rate) / std::tan(pi * cutoff / rate);
    double const expected = 1 / std::sqrt(1 + std::pow(warped, 2 * order));
    // gain k^2 of a low cut-off loses digits against 1 + a1 + a2
    double const k = std::tan(pi * cutoff / rate);
    EXPECT_NEAR(std::abs(response(sections, frequency, rate)), expected, 1e-13 + 1e-15 * order / (k * k)) << frequency;
  }
  EXPECT_NEAR(std::norm(response(sections, cutoff, rate)), 0.5, 1e-9);
}

TEST_P(ButterworthLowpass, PolesLieInsideTheUnitCircle) {
  auto const [order, cutoff, rate] = GetParam();
  for (auto const& s : butterworth_lowpass(order, cutoff, rate)) {
    EXPECT_LT(std::fabs(s.a2), 1.0);
    EXPECT_LT(std::fabs(s.a1), 1.0 + s.a2);
  }
}

INSTANTIATE_TEST_SUITE_P(Designs, ButterworthLowpass,
                         testing::Values(Design{1, 20, 100}, Design{2, 0.5, 100}, Design{3, 12, 100},
                                         Design{4, 100, 1000}, Design{4, 47, 1000}, Design{5, 49, 100},
                                         Design{8, 1, 1000}, Design{12, 200, 1000}));

Eigen::VectorXd random_signal(std::uint32_t seed, Eigen::Index n) {
  RandomStream stream({23, 0, RandomDomain::test}, 0, seed);
  Eigen::VectorXd signal(n);
  for (double& value : signal) value = stream.normal();
  return signal;
}

TEST(ZeroPhase, LeavesConstantsAndRampsAlone) {
  for (int order : {1, 2, 3, 4, 7}) {
    auto const sections = butterworth_lowpass(order, 10, 100);
    EXPECT_LT((zero_phase(sections, Eigen::VectorXd::Constant(200, 3.5)).array() - 3.5).abs().maxCoeff(), 1e-12);
    Eigen::VectorXd const ramp = Eigen::VectorXd::LinSpaced(400, -2.0, 5.0);
    // in the middle: what the ends start is forgotten there
    EXPECT_LT((zero_phase(sections, ramp) - ramp).segment(150, 100).cwiseAbs().maxCoeff(), 1e-10);
  }
}

TEST(ZeroPhase, AnswersAnImpulseSymmetrically) {
  Eigen::VectorXd impulse = Eigen::VectorXd::Zero(801);
  impulse[400] = 1;
  auto const answer = zero_phase(butterworth_lowpass(4, 60, 1000), impulse);
  EXPECT_LT((answer - answer.reverse()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(answer.sum(), 1.0, 1e-9);
}

TEST(ZeroPhase, SineKeepsItsPhaseAndLosesTheSquaredGain) {
  constexpr double rate = 1000, cutoff = 30;
  for (double frequency : {5.0, 20.0, 30.0, 60.0}) {
    Eigen::VectorXd sine(4000), cosine(4000);
    for (Eigen::Index i = 0; i < sine.size(); ++i) {
      sine[i] = std::sin(2 * pi * frequency * static_cast<double>(i) / rate);
      cosine[i] = std::cos(2 * pi * frequency * static_cast<double>(i) / rate);
    }
    auto const filtered = zero_phase(butterworth_lowpass(4, cutoff, rate), sine);
    // 1000 samples in the middle: whole periods of all four frequencies
    double const in_phase = 2 * filtered.segment(1500, 1000).dot(sine.segment(1500, 1000)) / 1000;
    double const quadrature = 2 * filtered.segment(1500, 1000).dot(cosine.segment(1500, 1000)) / 1000;
    double const warped = std::tan(pi * frequency / rate) / std::tan(pi * cutoff / rate);
    EXPECT_NEAR(in_phase, 1 / (1 + std::pow(warped, 8)), 1e-9) << frequency;
    EXPECT_NEAR(quadrature, 0.0, 1e-9) << frequency;
  }
}

TEST(ZeroPhase, IsLinearAndIndifferentToTheDirectionOfTime) {
  auto const sections = butterworth_lowpass(4, 47, 1000);
  auto const a = random_signal(1, 500), b = random_signal(2, 500);
  EXPECT_LT((zero_phase(sections, 2 * a - 3 * b) - 2 * zero_phase(sections, a) + 3 * zero_phase(sections, b))
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
  Eigen::VectorXd const reversed = zero_phase(sections, a.reverse()).reverse();
  // only what the far end starts differs; in the middle it is forgotten
  EXPECT_LT((reversed - zero_phase(sections, a)).segment(200, 100).cwiseAbs().maxCoeff(), 1e-9);
}

// scipy.signal.sosfiltfilt(butter(order, cutoff, fs=100, output="sos"), x) at samples 0, 1, 7, 20, 38, 39 of
// x_k = sin(0.3 k) + 0.005 k^2 - (k % 7 == 3), k = 0 .. 39: edges included
TEST(ZeroPhase, EqualsScipyAlsoAtTheEdges) {
  Eigen::VectorXd x(40);
  for (int k = 0; k < 40; ++k) x[k] = std::sin(0.3 * k) + 0.05 * k * k / 10 - (k % 7 == 3 ? 1 : 0);
  struct Reference {
    int order;
    double cutoff_hz;
    double y[6];
  };
  Reference const references[] = {{4,
                                   5,
                                   {0.06169839972877493, 0.22162720528188929, 0.6016181581262551, 1.6754307837724252,
                                    6.56020284738818, 6.880320571718343}},
                                  {3,
                                   12,
                                   {0.0009690662775729067, 0.16799255293699492, 1.032572143340855, 1.6393391366295824,
                                    6.263829462215941, 6.84649091393782}},
                                  {1,
                                   20,
                                   {-3.2838350803865435e-07, 0.2546141557392632, 1.0700592728023062, 1.7298275216060286,
                                    5.955574096887728, 6.8430150228222555}},
                                  {2,
                                   0.5,
                                   {0.34041146377838377, 0.3644306970660783, 0.5051426699703851, 0.7687141993834636,
                                    0.9584490543267178, 0.9620114548769332}}};
  int const samples[] = {0, 1, 7, 20, 38, 39};
  for (auto const& reference : references) {
    auto const y = zero_phase(butterworth_lowpass(reference.order, reference.cutoff_hz, 100), x);
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(y[samples[k]], reference.y[k], 1e-11) << reference.order << " " << samples[k];
  }
}

bool has_same_bits(Eigen::VectorXd const& a, Eigen::VectorXd const& b) {
  if (a.size() != b.size() || a.size() == 0) return a.size() == b.size();  // of nothing there is no pointer
  return std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

TEST(ZeroPhaseColumns, HaveTheBitsOfOneAtATime) {
  for (int order : {1, 4, 5}) {
    auto const sections = butterworth_lowpass(order, 30, 1000);
    for (Eigen::Index width = 0; width <= 9; ++width) {
      Eigen::MatrixXd signals(300, width);
      for (Eigen::Index k = 0; k < width; ++k)
        // sizes that a neighbour's rounding would show in
        signals.col(k) = std::pow(10.0, 4.0 - 2.0 * static_cast<double>(k)) *
                         random_signal(100 + static_cast<std::uint32_t>(k), signals.rows());
      Eigen::MatrixXd const together = zero_phase_columns(sections, signals);
      ASSERT_EQ(together.rows(), signals.rows());
      ASSERT_EQ(together.cols(), width);
      Eigen::MatrixXd in_place = signals;
      zero_phase_in_place(sections, in_place);
      EXPECT_TRUE(has_same_bits(in_place.reshaped(), together.reshaped())) << order << " " << width;
      for (Eigen::Index k = 0; k < width; ++k)
        EXPECT_TRUE(has_same_bits(together.col(k), zero_phase(sections, signals.col(k))))
            << order << " " << width << " " << k;
    }
  }
}

TEST(ZeroPhaseColumns, AreNotTouchedByANeighbourThatIsNoNumber) {
  auto const sections = butterworth_lowpass(4, 30, 1000);
  Eigen::MatrixXd signals(300, 3);
  for (Eigen::Index k = 0; k < 3; ++k) signals.col(k) = random_signal(200 + static_cast<std::uint32_t>(k), 300);
  Eigen::VectorXd const alone = zero_phase(sections, signals.col(0));
  signals(150, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(has_same_bits(zero_phase_columns(sections, signals).col(0), alone));
}

// a pulse and then nothing for long: the recursion falls below the smallest normal number. Kept as it is, each such
// number would cost a hundred ordinary ones
TEST(ZeroPhaseColumns, FallToZeroWithoutDenormals) {
  constexpr Eigen::Index n = 60000;
  auto const sections = butterworth_lowpass(4, 30, 200);
  Eigen::MatrixXd signals = Eigen::MatrixXd::Zero(n, 3);
  signals.middleRows(100, 20).setOnes();
  signals.col(2).setZero();
  Eigen::MatrixXd const filtered = zero_phase_columns(sections, signals);
  EXPECT_GT(filtered.col(0).maxCoeff(), 0.9);
  EXPECT_EQ(filtered.col(0).tail(n / 2), Eigen::VectorXd(Eigen::VectorXd::Zero(n / 2)));
  EXPECT_EQ(filtered.col(2), Eigen::VectorXd(Eigen::VectorXd::Zero(n)));
  for (double value : filtered.reshaped()) ASSERT_NE(std::fpclassify(value), FP_SUBNORMAL);
}

// the flag belongs to the filter: code that runs after it has its small numbers again
TEST(ZeroPhaseColumns, LeaveSmallNumbersToOthers) {
  Eigen::VectorXd const signal = random_signal(9, 300);
  zero_phase(butterworth_lowpass(4, 30, 1000), signal);
  double volatile small = std::numeric_limits<double>::min();
  double volatile half = small / 2.0;
  EXPECT_GT(half, 0.0);
}

}  // namespace zero_phase_test
}  // namespace torquescope
