// the energy kernels allocate nothing and write only where they may
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "unit/kernels/every_instruction_set.hpp"
#include "unit/kernels/random_problem.hpp"

namespace {
std::atomic<std::size_t> n_allocations{0};
}  // namespace

// counts what the test AllocatesNothing must not see; noinline, or GCC pairs our malloc with somebody else's delete
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++n_allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++n_allocations;
  std::size_t const unit = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace torquescope::kernels {
namespace {

INSTANTIATE_TEST_SUITE_P(Memory, EveryInstructionSet, testing::ValuesIn(supported_instruction_sets()),
                         instruction_set_of);

TEST_P(EveryInstructionSet, WritesOnlyEnergyAndWorkspace) {
  RandomProblem const problem(5000, 7, 11, 4);
  std::size_t const size = energy_workspace_size(5000, 7, 11);
  double const guard = 12345.0;
  AlignedDoubles workspace(size + 64, guard);
  std::vector<double> energy(11 + 64, guard);
  residual_energy(problem.tiles(), problem.candidates(), energy.data(), workspace.data());
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_EQ(workspace[size + i], guard);
    EXPECT_EQ(energy[11 + i], guard);
  }
}

TEST_P(EveryInstructionSet, AllocatesNothing) {
  RandomProblem const problem(5000, 7, 11, 4);
  AlignedDoubles workspace(energy_workspace_size(5000, 7, 11));
  std::vector<double> energy(11);
  std::size_t const before = n_allocations;
  residual_energy(problem.tiles(), problem.candidates(), energy.data(), workspace.data());
  huber_energy(problem.tiles(), problem.candidates(), 1.0, energy.data(), workspace.data());
  EXPECT_EQ(n_allocations, before);
}

}  // namespace
}  // namespace torquescope::kernels
