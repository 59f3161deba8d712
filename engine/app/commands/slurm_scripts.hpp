#pragma once
// The batch scripts of `submit`: jobs/slurm/*.sbatch, which people can also edit themselves, with their lines filled
// in.
//
// Quoting    a path is a word for the shell in the lines that bash reads (shell_word), and one for sbatch in the lines
//            that begin with #SBATCH (sbatch_word, sbatch_pattern): blanks, quotes, %, #, letters of any language
// Errors     64 from check_plan for what neither can carry: a line break, or another control character, in any of the
//            words; a backslash in the result, after which Slurm no longer fills in the number of the task

#include <cstdint>
#include <string>

namespace torquescope {

struct SlurmPlan {
  std::string program, job, result, name;
  std::int64_t shards = 1, threads = 1;
  std::string time{};               // "" leaves what the script says
  std::string partition{};          // "" leaves it to the cluster
  double save_every_s = 0.0;        // 0 leaves what the script says
  bool diagnoses = false;           // every task can finish the diagnosis: then nothing is to be merged
  std::uintmax_t result_bytes = 0;  // of what is merged
};

void check_plan(SlurmPlan const& plan);

std::string array_script(SlurmPlan const& plan);
std::string merge_script(SlurmPlan const& plan);
// "1-02:30:00", or "" where what the script says suffices
std::string merge_time(std::uintmax_t result_bytes);

// 'a word of a shell', whatever letters it has
std::string shell_word(std::string const& text);
// "a word of sbatch", in a line of options
std::string sbatch_word(std::string const& text);
// the same of a file's name, in which % stands for itself
std::string sbatch_pattern(std::string const& name, std::string const& ending);

}  // namespace torquescope
