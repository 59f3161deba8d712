// One peer on the seed's job: bench_peers PEER FILE RUNS prints the CPU seconds of the searches alone, and what they
// found.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>

#include "bench/peers/problem.hpp"

namespace peers {

Problem read_problem(std::string const& file) {
  std::ifstream stream(file, std::ios::binary);
  std::uint64_t size[2] = {};
  auto const read = [&](auto* numbers, std::size_t count) {
    stream.read(reinterpret_cast<char*>(numbers), static_cast<std::streamsize>(count * sizeof(*numbers)));
  };
  read(size, 2);
  Problem problem{size[0], size[1], {}, {}};
  if (!stream || problem.n == 0 || problem.R != 4)
    throw std::runtime_error(file + " is no seed job of four parameters");
  problem.phi.resize(problem.n * problem.R);
  problem.tau.resize(problem.n);
  read(problem.phi.data(), problem.phi.size());
  read(problem.tau.data(), problem.tau.size());
  if (!stream) throw std::runtime_error(file + " ends too early");
  return problem;
}

namespace {

double cpu_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int run(std::string const& peer, std::string const& file, unsigned runs) {
  std::map<std::string, Search> const searches{{"pagmo_de", pagmo_de},
                                               {"nlopt_crs2", nlopt_crs2},
                                               {"openblas_de", openblas_de},
                                               {"eigen_de", eigen_de},
                                               {"textbook_de", textbook_de}};
  Problem const problem = read_problem(file);
  std::vector<double> mse;
  double const start = cpu_seconds();
  for (unsigned seed = 1; seed <= runs; ++seed) mse.push_back(searches.at(peer)(problem, seed));
  double const seconds = cpu_seconds() - start;
  std::sort(mse.begin(), mse.end());
  std::printf("{\"search_s\": %.9g, \"mse\": %.17g}\n", seconds, mse[mse.size() / 2]);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace peers

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fprintf(stderr, "bench_peers PEER FILE RUNS\n");
    return 64;
  }
  return peers::run(argv[1], argv[2], static_cast<unsigned>(std::atoi(argv[3])));
} catch (std::exception const& error) {
  std::fprintf(stderr, "bench_peers: %s\n", error.what());
  return EXIT_FAILURE;
}
