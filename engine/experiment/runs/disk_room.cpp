#include "engine/experiment/runs/disk_room.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/experiment/runs/population_stage.hpp"
#include "engine/store/disk_failure.hpp"
#include "engine/store/result_files.hpp"

namespace torquescope {
namespace {

// sizes that the job reader allows (check_sizes) fit; a sum of a few of them does too
std::uintmax_t history_bytes(HistoryShape const& shape, std::size_t runs, std::size_t generations_of_run) {
  std::uintmax_t const generations = runs * generations_of_run;
  std::uintmax_t numbers = generations;  // evaluations
  for (auto const& list : history_lists) numbers += generations * list.width(shape);
  return numbers * sizeof(double);
}

// what the last states of runs hold beside their populations: fitness and, at most, an archive as large
std::uintmax_t last_state_bytes(HistoryShape const& shape, std::size_t runs) {
  constexpr std::uintmax_t headers = std::uintmax_t{4} << 10;
  return headers + runs * static_cast<std::uintmax_t>(shape.members * (shape.parameters + 1)) * sizeof(double);
}

std::uintmax_t sample_bytes(DataSet const& set) {
  constexpr std::uintmax_t channels = 6;  // time, recording, position, velocity, acceleration, torque
  auto const rows = static_cast<std::uintmax_t>(set.regression.rows());
  return rows * (channels + static_cast<std::uintmax_t>(set.regression.parameters())) * sizeof(double);
}

std::uintmax_t all_sample_bytes(Experiment::Parts const& parts) {
  if (!parts.output.samples) return 0;
  return sample_bytes(parts.train) + (parts.validate ? sample_bytes(*parts.validate) : 0);
}

constexpr std::uintmax_t bytes_of_names = std::uintmax_t{16} << 10;

std::uintmax_t stored_bytes(Experiment::Parts const& parts, std::uintmax_t bytes) {
  constexpr std::uintmax_t gzip_shrinks_to_less_than_a = 10;
  return bytes_of_names + (parts.output.compression == "gzip" ? bytes / gzip_shrinks_to_less_than_a : bytes);
}

}  // namespace

std::uintmax_t result_bytes(Experiment::Parts const& parts) {
  constexpr std::uintmax_t curves_and_surfaces = std::uintmax_t{64} << 10, path_numbers = 4;
  auto const runs = static_cast<std::size_t>(parts.experiment.runs);
  std::uintmax_t bytes = 0;
  for (auto const& plan : parts.estimators) {
    if (plan.is_closed_form()) continue;
    HistoryShape const shape = history_shape(parts, plan);
    StoredGenerations const stored = stored_generations(parts, plan);
    bytes += history_bytes(shape, runs, stored.count());
    bytes += stored.all() ? last_state_bytes(shape, runs) : runs * sizeof(double);
    bytes += (runs + stored.count() + shape.members) * sizeof(double);  // scales
    if (plan.controller) bytes += curves_and_surfaces + runs * stored.count() * path_numbers * sizeof(double);
  }
  return stored_bytes(parts, bytes + all_sample_bytes(parts));
}

std::uintmax_t segment_bytes(Experiment::Parts const& parts, std::size_t runs) {
  if (runs == 0) return 0;
  std::uintmax_t bytes = bytes_of_names;
  for (auto const& plan : parts.estimators) {
    if (plan.is_closed_form()) continue;
    HistoryShape const shape = history_shape(parts, plan);
    bytes += history_bytes(shape, runs, shape.generations + 1) + last_state_bytes(shape, runs);
  }
  return bytes;
}

std::uintmax_t diagnosis_bytes(Experiment::Parts const& parts) {
  constexpr std::uintmax_t numbers_of_a_trace = 6;  // time, torque, residual before and after, velocity, position
  DataSet const& drawn = parts.validate ? *parts.validate : parts.train;
  auto const rows = static_cast<std::uintmax_t>(drawn.regression.rows());
  return stored_bytes(parts, all_sample_bytes(parts) + rows * numbers_of_a_trace * sizeof(double));
}

void check_room(RoomWish const& wish, std::uintmax_t needed, std::filesystem::path const& file) {
  refuse_long_name(wish.output);
  auto const free = free_bytes_for(wish.output);
  if (!free || *free >= needed) return;
  std::string const words = fmt::format("{} needs up to {} bytes, and {} are free there", file.string(), needed, *free);
  if (wish.allow_full_disk) {
    if (wish.tell) wish.tell("warning", words + ": --allow-full-disk");
    return;
  }
  throw Error(Problem{.code = ExitCode::io,
                      .what = words,
                      .notes = {"nothing was begun"},
                      .help = fmt::format("make room, --out another folder, {}, [output] compression = \"gzip\"; or "
                                          "begin all the same with --allow-full-disk",
                                          wish.smaller)});
}

void check_room(IdentifyOptions const& options, std::uintmax_t needed, std::filesystem::path const& file) {
  check_room({options.output, options.allow_full_disk, options.tell, "fewer runs or generations"}, needed, file);
}

}  // namespace torquescope
