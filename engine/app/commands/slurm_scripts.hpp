#pragma once
// The batch scripts of `submit`: jobs/slurm/*.sbatch, which people can also edit themselves, with their lines filled
// in.

#include <cstdint>
#include <string>

namespace torquescope {

struct SlurmPlan {
  std::string program, job, result, name;
  std::int64_t shards = 1, threads = 1;
  std::string time{};         // "" leaves what the script says
  std::string partition{};    // "" leaves it to the cluster
  double save_every_s = 0.0;  // 0 leaves what the script says
};

std::string array_script(SlurmPlan const& plan);
std::string merge_script(SlurmPlan const& plan);

// 'a word of a shell', whatever letters it has
std::string shell_word(std::string const& text);

}  // namespace torquescope
