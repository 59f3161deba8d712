#pragma once
// A small result with every kind of object that results have; what the tests of the store write, damage and read.
//
// Shapes     runs = 3, generations + 1 = 5, members = 4, parameters = 2; 300 samples

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/store/result_writer.hpp"

namespace torquescope::example {

inline constexpr std::size_t runs = 3, entries = 5, members = 4, parameters = 2, samples = 300;

inline std::vector<double> population(std::size_t run) {
  std::vector<double> values(entries * members * parameters);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<double>(run * values.size() + i));
  return values;
}

inline std::vector<double> torque() {
  std::vector<double> values(samples);
  for (std::size_t i = 0; i < samples; ++i) values[i] = std::cos(0.01 * static_cast<double>(i * i));
  return values;
}

inline std::vector<std::int64_t> evaluations(std::size_t run) {
  std::vector<std::int64_t> values;
  for (std::size_t i = 0; i < entries; ++i) values.push_back(static_cast<std::int64_t>((i + 1) * members + run));
  return values;
}

inline void write_job(ResultWriter& writer) {
  writer.attribute("/job", "name", std::string("crs_a465_joint"));
  writer.attribute("/job", "seed", std::int64_t{42});
  std::vector<std::string> const text{"[experiment]\nname = \"crs_a465_joint\"  # M\u00fcnchen\n"};
  writer.texts("/job/text", text, {"1", "job file, verbatim"});
  writer.attribute("/model", "joint", std::string("revolute"));
  writer.texts("/model/names", std::vector<std::string>{"inertia", "viscous"}, {"1", "parameter names"});
  writer.attribute("/data/train", "recordings", std::vector<std::string>{"a.csv", "b.csv"});
  writer.attribute("/data/train", "rate_hz", 200.0);
  writer.numbers("/data/train/torque", {samples}, torque(), {"N m", "measured torque"});
  writer.attribute("/runs", "order", std::vector<std::string>{"ols", "fade"});
  writer.attribute("/runs/ols", "kind", std::string("ols"));
  writer.numbers("/runs/ols/parameters", {1, 2}, std::vector<double>{0.0036, 0.0164}, {"1", "estimates"});
}

inline void declare_fade(ResultWriter& writer) {
  writer.attribute("/runs/fade", "kind", std::string("fade"));
  writer.attribute("/runs/fade", "cr_start", 0.5);
  writer.attribute("/runs/fade", "parameters_mean", std::vector<double>{0.0036, 0.0164});
  writer.declare_runs("/runs/fade/population", runs, {entries, members, parameters}, {"1", "members", "FADE, eq. 3"});
  writer.declare_runs("/runs/fade/evaluations", runs, {entries}, {"1", "evaluations so far"}, RunValues::whole_number);
  writer.declare_runs("/runs/fade/mse", runs, {}, {"(N m)2", "mean squared error"});
}

inline void write_fade_run(ResultWriter& writer, std::size_t run) {
  writer.write_run("/runs/fade/population", run, population(run));
  writer.write_run("/runs/fade/evaluations", run, evaluations(run));
  double const mse = 0.09 + 0.001 * static_cast<double>(run);
  writer.write_run("/runs/fade/mse", run, std::span<double const>(&mse, 1));
}

// returns content_sha256
inline std::string write_result(std::filesystem::path const& name, ResultWriterOptions options = {},
                                std::vector<std::size_t> const& order_of_runs = {0, 1, 2},
                                std::string const& host = "node7") {
  ResultWriter writer(name, options);
  write_job(writer);
  declare_fade(writer);
  for (std::size_t run : order_of_runs) write_fade_run(writer, run);
  writer.plottable("/data/train", "torque", {"."});
  writer.attribute("/provenance", "host", host);
  return writer.finish();
}

}  // namespace torquescope::example
