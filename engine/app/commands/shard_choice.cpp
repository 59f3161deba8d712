#include "engine/app/commands/shard_choice.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "engine/base/error.hpp"

namespace torquescope {

namespace {

std::optional<std::size_t> count_of(std::string const& text) {
  std::size_t value = 0;
  auto const [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  bool const whole = !text.empty() && failure == std::errc{} && end == text.data() + text.size();
  return whole && value <= 10'000'000 ? std::optional(value) : std::nullopt;
}

std::optional<ShardChoice> shard_of(std::string const& text) {
  std::size_t const slash = text.find('/');
  if (slash == std::string::npos) return std::nullopt;
  auto const index = count_of(text.substr(0, slash)), count = count_of(text.substr(slash + 1));
  if (!index || !count || *index >= *count) return std::nullopt;
  return ShardChoice{*index, *count, "--shard"};
}

std::optional<ShardChoice> array_task(ReadVariable const& variable) {
  auto const id = count_of(variable("SLURM_ARRAY_TASK_ID")), count = count_of(variable("SLURM_ARRAY_TASK_COUNT"));
  if (!id || !count || *count < 2) return std::nullopt;
  std::size_t const first = count_of(variable("SLURM_ARRAY_TASK_MIN")).value_or(0);
  std::size_t const last = count_of(variable("SLURM_ARRAY_TASK_MAX")).value_or(first + *count - 1);
  std::size_t const step = std::max<std::size_t>(1, count_of(variable("SLURM_ARRAY_TASK_STEP")).value_or(1));
  bool const regular = *id >= first && last == first + (*count - 1) * step && (*id - first) % step == 0;
  validate(regular, [&] {
    return Problem{.code = ExitCode::usage,
                   .what = fmt::format("task {} of this Slurm array has no place in a row of {}", *id, *count),
                   .help = "say the share yourself: --shard I/N with I = 0 to N - 1, or --shard 0/1 for all runs"};
  });
  return ShardChoice{(*id - first) / step, *count, "SLURM_ARRAY_TASK_ID"};
}

std::optional<ShardChoice> rank(ReadVariable const& variable, char const* index_name, char const* count_name) {
  auto const index = count_of(variable(index_name)), count = count_of(variable(count_name));
  if (!index || !count || *count < 2 || *index >= *count) return std::nullopt;
  return ShardChoice{*index, *count, index_name};
}

}  // namespace

std::string no_shard(std::string const& text) {
  return shard_of(text) ? "" : fmt::format("\"{}\" is no share I/N with I = 0 to N - 1, like 0/4", text);
}

ShardChoice choose_shard(std::string const& given, ReadVariable const& variable) {
  if (!given.empty()) return shard_of(given).value_or(ShardChoice{});
  // in the batch script itself SLURM_PROCID is 0 of SLURM_NTASKS, and nobody else runs: only a step has ranks
  auto const task = rank(variable, "SLURM_PROCID", "SLURM_STEP_NUM_TASKS");
  if (auto const array = array_task(variable)) {
    if (!task) return *array;
    return {array->index * task->count + task->index, array->count * task->count, "SLURM_ARRAY_TASK_ID, SLURM_PROCID"};
  }
  if (task) return *task;
  return rank(variable, "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE").value_or(ShardChoice{});
}

}  // namespace torquescope
