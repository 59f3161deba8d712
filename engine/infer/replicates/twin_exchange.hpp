#pragma once
// Who computes the clean twins of a diagnosis: this process alone, or several that make the same diagnosis and share
// them.
//
// Batches    a diagnosis is deterministic: every process of it asks for the same batches in the same order, and each
//            twin has the same numbers whoever computes it (engine/workflows/twin_folder.hpp exchanges them in files)
// Threads    fill() by one thread at a time

#include <Eigen/Core>
#include <cstddef>
#include <exception>
#include <functional>
#include <span>
#include <string>

namespace torquescope {

// which twins of an address: [from, to), from a multiple of twin_lanes
struct TwinRange {
  std::size_t from = 0, to = 0;
  std::size_t size() const { return to - from; }
};

struct TwinBatch {
  std::string identity;  // SHA-256 of what tells one batch of a diagnosis from another
  TwinRange range;
  Eigen::Index samples = 0;                         // of each twin at the full rate: what it costs
  std::size_t numbers = 0;                          // of each twin
  std::function<void(TwinRange const&)> compute{};  // some of them, into their places
  std::function<void(std::size_t twin, std::span<double> out)> get{};
  std::function<void(std::size_t twin, std::span<double const> in)> put{};
};

class TwinExchange {
 public:
  TwinExchange() = default;
  virtual ~TwinExchange() = default;
  TwinExchange(TwinExchange const&) = delete;
  TwinExchange& operator=(TwinExchange const&) = delete;

  // every twin of the batch into its place. Errors: those of compute(); TwinsAbandoned
  virtual void fill(TwinBatch const& batch) = 0;
};

// The diagnosis is to end without a result of its own. No Error: a search tries models and goes on without those that
// fail, and must not take this for one
class TwinsAbandoned : public std::exception {
 public:
  char const* what() const noexcept override { return "replicates abandoned"; }
};

struct TwinWorkers {
  int threads = 1;
  TwinExchange* exchange = nullptr;  // nobody to share with

  // NOLINTNEXTLINE(google-explicit-constructor): most callers have nothing but threads
  TwinWorkers(int n_threads, TwinExchange* shared = nullptr) : threads(n_threads), exchange(shared) {}
};

}  // namespace torquescope
