#pragma once
// A random packed recording with candidates, reproducible from its seed: for the tests of the energy kernels.

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "kernels/aligned_doubles.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/residual_energy.hpp"
#include "kernels/sample_tiles.hpp"

namespace torquescope::kernels {

struct RandomProblem {
  std::size_t n_samples, n_regressors, n_members;
  std::size_t phi_stride, member_stride;  // leading dimensions, a little larger than needed
  std::vector<double> phi, tau, members;
  AlignedDoubles packed;

  RandomProblem(std::size_t n, std::size_t n_r, std::size_t n_m, std::uint32_t seed)
      : n_samples(n), n_regressors(n_r), n_members(n_m), phi_stride(n + seed % 3), member_stride(n_r + seed % 4) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    auto const fill = [&](std::vector<double>& numbers, std::size_t size) {
      numbers.resize(size);
      for (double& number : numbers) number = normal(random);
    };
    fill(phi, phi_stride * n_r);
    fill(tau, n);
    fill(members, member_stride * n_m);
    packed.resize(packed_size(n, n_r));
    pack_tiles(phi.data(), phi_stride, tau.data(), n, n_r, packed.data());
  }

  double phi_at(std::size_t i, std::size_t r) const { return phi[r * phi_stride + i]; }
  double member_at(std::size_t m, std::size_t r) const { return members[m * member_stride + r]; }
  SampleTiles tiles() const { return {packed.data(), n_samples, n_regressors}; }
  Candidates candidates() const { return {members.data(), n_members, member_stride}; }
  Candidates candidates(std::size_t first, std::size_t count) const {
    return {members.data() + first * member_stride, count, member_stride};
  }
  std::string name() const {
    return std::to_string(n_samples) + " samples, " + std::to_string(n_regressors) + " regressors, " +
           std::to_string(n_members) + " members on " + std::string(instruction_set());
  }
};

inline AlignedDoubles workspace_for(SampleTiles const& tiles, Candidates const& candidates) {
  return AlignedDoubles(energy_workspace_size(tiles.n_samples, tiles.n_regressors, candidates.n_members));
}

inline std::vector<double> residual_energies(SampleTiles const& tiles, Candidates const& candidates) {
  std::vector<double> energy(candidates.n_members);
  auto workspace = workspace_for(tiles, candidates);
  residual_energy(tiles, candidates, energy.data(), workspace.data());
  return energy;
}

inline std::vector<double> huber_energies(SampleTiles const& tiles, Candidates const& candidates, double delta) {
  std::vector<double> energy(candidates.n_members);
  auto workspace = workspace_for(tiles, candidates);
  huber_energy(tiles, candidates, delta, energy.data(), workspace.data());
  return energy;
}

}  // namespace torquescope::kernels
