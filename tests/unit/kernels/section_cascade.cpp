// Sections side by side give on every instruction set the bits of one signal filtered by the textbook's loop.

#include "kernels/section_cascade.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "unit/kernels/every_instruction_set.hpp"

namespace torquescope::kernels {
namespace section_cascade_test {

// two resonant low-passes of order two and one of order one, gain 1 at f = 0
std::vector<CascadeSection> sections(std::size_t count) {
  std::vector<CascadeSection> const all{{0.0201, 0.0402, 0.0201, -1.5610, 0.6414},
                                        {0.0675, 0.1349, 0.0675, -1.1430, 0.4128},
                                        {0.2452, 0.2452, 0.0, -0.5096, 0.0}};
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)};
}

double sample(std::size_t i, std::size_t signal) {
  return std::sin(0.03 * static_cast<double>((i + 1) * (signal + 1))) + 0.1 * static_cast<double>(i * i % 17);
}

// one signal, one section after the other, forwards
std::vector<double> textbook(std::vector<CascadeSection> const& cascade, std::vector<double> x) {
  for (auto const& s : cascade) {
    double z1 = (1 - s.b0) * x[0], z2 = (s.b2 - s.a2) * x[0];
    for (double& value : x) {
      double const y = s.b0 * value + z1;
      z1 = s.b1 * value - s.a1 * y + z2;
      z2 = s.b2 * value - s.a2 * y;
      value = y;
    }
  }
  return x;
}

class SectionCascade : public EveryInstructionSet {};

TEST_P(SectionCascade, GivesTheBitsOfTheTextbookInBothDirections) {
  for (std::size_t signals : {2, 4, 8})
    for (std::size_t n_sections : {0, 1, 2, 3})
      for (std::size_t n : {0, 1, 2, 7, 200}) {
        auto const cascade = sections(n_sections);
        std::vector<double> forwards(n * signals), backwards(n * signals);
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t k = 0; k < signals; ++k)
            forwards[i * signals + k] = backwards[(n - 1 - i) * signals + k] = sample(i, k);
        run_cascade(cascade.data(), n_sections, forwards.data(), n, signals, CascadeDirection::forwards);
        run_cascade(cascade.data(), n_sections, backwards.data(), n, signals, CascadeDirection::backwards);
        for (std::size_t k = 0; k < signals && n > 0; ++k) {
          std::vector<double> signal(n);
          for (std::size_t i = 0; i < n; ++i) signal[i] = sample(i, k);
          auto const expected = textbook(cascade, signal);
          for (std::size_t i = 0; i < n; ++i) {
            ASSERT_EQ(forwards[i * signals + k], expected[i]) << n_sections << " sections, sample " << i;
            ASSERT_EQ(backwards[(n - 1 - i) * signals + k], expected[i]) << "backwards, sample " << i;
          }
        }
      }
}

INSTANTIATE_TEST_SUITE_P(Target, SectionCascade, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

}  // namespace section_cascade_test
}  // namespace torquescope::kernels
