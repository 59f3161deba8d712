#pragma once
// Some generations of one run, [first, first + count): what a segment holds, and what a run goes on from.
//
// Lists      of one number per generation, but population (NP x R) and fitness (NP); `history_lists` names them all
//            once
// Threads    plain records and free functions

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/experiment/runs/run_history.hpp"
#include "engine/fit/optim/optimiser.hpp"

namespace torquescope {

// sizes of every history of one population method
struct HistoryShape {
  std::size_t runs = 0;
  std::size_t generations = 0;  // without the initial one
  std::size_t members = 0;      // 0: populations are not kept
  std::size_t parameters = 0;

  bool operator==(HistoryShape const&) const = default;
};

// numbers that one generation adds to a list of this name
struct HistoryList {
  char const* name;
  std::vector<double> RunHistory::*values;
  std::size_t (*width)(HistoryShape const&);
};

inline constexpr std::array<HistoryList, 8> history_lists{{
    {"population", &RunHistory::population, [](HistoryShape const& s) { return s.members * s.parameters; }},
    {"fitness", &RunHistory::fitness, [](HistoryShape const& s) { return s.members; }},
    {"F", &RunHistory::F, [](HistoryShape const&) { return std::size_t{1}; }},
    {"CR", &RunHistory::CR, [](HistoryShape const&) { return std::size_t{1}; }},
    {"PC", &RunHistory::PC, [](HistoryShape const&) { return std::size_t{1}; }},
    {"FC", &RunHistory::FC, [](HistoryShape const&) { return std::size_t{1}; }},
    {"best", &RunHistory::best, [](HistoryShape const&) { return std::size_t{1}; }},
    {"gap_history", &RunHistory::gap, [](HistoryShape const&) { return std::size_t{1}; }},
}};

struct RunPart {
  std::size_t run = 0;
  std::size_t first = 0, count = 0;  // generations; the initial population is 0
  bool ended = false;                // then the whole history's end is in the part
  RunHistory history{};              // of these generations; nonfinite and elapsed_s count from the run's beginning
  OptimiserState state{};            // of its optimiser at the end; of a run that has ended, the history's last state
  // to be written without a copy: all of the run that has these generations, and `history` says nothing
  std::shared_ptr<RunHistory const> whole{};

  std::size_t end() const { return first + count; }
};

// generations [first, end) of a longer history
RunPart part_of(RunHistory const& history, HistoryShape const& shape, std::size_t run, std::size_t first,
                std::size_t end);

// appends generations [first, ...) of a part to a history that ends there
void append(RunHistory& history, RunPart const& part, HistoryShape const& shape, std::size_t first);

// where a part says something else than the history about generations both have: the first of them, or part.end()
std::size_t first_difference(RunHistory const& history, RunPart const& part, HistoryShape const& shape);

}  // namespace torquescope
