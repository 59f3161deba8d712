#pragma once
// A small result with every kind of object that results have; what the tests of the store write, damage and read.
//
// Shapes     runs = 3, generations + 1 = 5, members = 4, parameters = 2; 300 samples

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/store/scale_datasets.hpp"

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
  writer.numbers("/data/train/torque", {samples}, torque(), Note{"N m", "measured torque"}.over({"sample"}));
  write_index(writer, "/data/train", "sample", samples);
  writer.attribute("/runs", "order", std::vector<std::string>{"ols", "fade"});
  writer.attribute("/runs/ols", "kind", std::string("ols"));
  writer.numbers("/runs/ols/parameters", {1, 2}, std::vector<double>{0.0036, 0.0164}, {"1", "estimates"});
}

inline void declare_fade(ResultWriter& writer) {
  writer.attribute("/runs/fade", "kind", std::string("fade"));
  writer.attribute("/runs/fade", "cr_start", 0.5);
  writer.attribute("/runs/fade", "parameters_mean", std::vector<double>{0.0036, 0.0164});
  writer.declare_runs("/runs/fade/population", runs, {entries, members, parameters},
                      Note{"1", "members", "FADE, eq. 3"}.over({"run", "generation", "member", "parameter"}));
  writer.declare_runs("/runs/fade/evaluations", runs, {entries}, {"1", "evaluations so far"}, RunValues::whole_number);
  writer.declare_runs("/runs/fade/mse", runs, {}, Note{"(N m)2", "mean squared error"}.over({"run"}));
  write_index(writer, "/runs", "run", runs);  // a scale of a group around
  write_index(writer, "/runs/fade", "generation", entries);
  write_index(writer, "/runs/fade", "member", members);
  write_names(writer, "/runs/fade", "parameter", std::vector<std::string>{"inertia", "viscous"});
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

// every way in which values are cut into chunks and blocks, and values that are easily lost; returns content_sha256
inline std::string write_large_result(std::filesystem::path const& name, ResultWriterOptions options = {}) {
  auto const values = [](std::size_t count, std::size_t seed) {
    std::vector<double> all(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = std::sin(static_cast<double>(seed + i));
    return all;
  };
  ResultWriter writer(name, options);
  writer.attribute("/a-b", "yes", true);
  writer.attribute("/a-b", "no_text", std::string());
  writer.attribute("/a-b", "no_texts", std::vector<std::string>{});
  writer.attribute("/a-b", "no_numbers", std::vector<double>{});
  writer.attribute("/a-b", "columns", std::map<std::string, std::string>{{"time", "t_s"}});
  writer.attribute("/a-b", "again", 1.0);
  writer.attribute("/a-b", "again", std::vector<double>{std::nan(""), -0.0});
  writer.numbers("/a/one", {}, values(1, 7), {"1", "one number alone"});
  writer.numbers("/a/none", {0, 4}, {}, {"1", "no rows"});
  writer.numbers("/a/long", {200001, 3}, values(600003, 1), {"1", "several chunks, the last one not full"});
  writer.numbers("/a/wide", {2, 3, 70001}, values(420006, 2), {"1", "rows larger than a chunk"});
  writer.texts("/a/words", std::vector<std::string>{"", "Tr\u00e4gheit", std::string(5000, 'x')}, {"1", "words"});
  constexpr std::size_t small_runs = 203, small = 101, many_runs = 3, many = 101 * 60 * 30;
  writer.declare_runs("/h/small", small_runs, {small}, {"1", "several runs in a block"});
  writer.declare_runs("/h/counts", small_runs, {}, {"1", "one number per run"}, RunValues::whole_number);
  writer.declare_runs("/h/large", many_runs, {101, 60, 30}, {"1", "several chunks per run"});
  for (std::size_t i = 0; i + 1 < small_runs; ++i) {
    std::size_t const run = i * 64 % small_runs;  // the last one of this order never comes
    writer.write_run("/h/small", run, values(small, run));
    auto const count = static_cast<std::int64_t>(run);
    writer.write_run("/h/counts", run, std::span<std::int64_t const>(&count, 1));
  }
  for (std::size_t run : {2U, 0U}) writer.write_run("/h/large", run, values(many, run));
  return writer.finish();
}

}  // namespace torquescope::example
