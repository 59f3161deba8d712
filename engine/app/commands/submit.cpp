#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cctype>
#include <memory>
#include <string_view>
#include <vector>

#include "engine/app/commands/command.hpp"
#include "engine/app/commands/slurm_scripts.hpp"
#include "engine/app/result/finished_result.hpp"
#include "engine/base/error.hpp"
#include "engine/base/interrupted_call.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/experiment/runs/disk_room.hpp"
#include "engine/store/result_files.hpp"
#include "engine/store/temp_file.hpp"

extern char** environ;

namespace torquescope {

namespace {

struct SubmitArguments {
  std::string job;
  std::string out{};
  std::int64_t shards = 0;
  int threads = 0;
  std::string time{}, partition{};
  double save_every_s = 0.0;  // 0: not given
  bool dry_run = false;
  std::vector<std::string> sbatch_options{};
};

std::string this_program() {
  std::error_code failed;
  auto const path = std::filesystem::read_symlink("/proc/self/exe", failed);
  return failed ? "torquescope" : path.string();
}

Error not_submitted(std::string const& what, std::string const& help) {
  return Error(Problem{.code = ExitCode::no_input, .what = what, .help = help});
}

// reads what sbatch says on stdout; its stderr is ours, so that people read its words as it wrote them
class Sbatch {
 public:
  explicit Sbatch(std::vector<std::string> words) {
    std::vector<char*> pointers;
    for (auto& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_CLOEXEC) != 0) return;
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    pid_t child = 0;
    failure_ = ::posix_spawnp(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    char piece[256];
    if (failure_ == 0)
      for (ssize_t n = 1; n > 0;) {
        n = unless_interrupted([&] { return ::read(ends[0], piece, sizeof(piece)); });
        said_.append(piece, static_cast<std::size_t>(std::max<ssize_t>(0, n)));
      }
    ::close(ends[0]);
    int status = 0;
    ended_well_ = failure_ == 0 && unless_interrupted([&] { return ::waitpid(child, &status, 0); }) == child &&
                  WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

  bool was_started() const { return failure_ == 0; }
  // of the job it made, "1234" or "1234;cluster"; "" for none
  std::string number() const {
    std::string const text = said_.substr(0, said_.find_first_of(";\n"));
    bool const is_number = ended_well_ && !text.empty() &&
                           std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    return is_number ? text : "";
  }

 private:
  int failure_ = -1;
  bool ended_well_ = false;
  std::string said_;
};

std::vector<std::string> sbatch_words(std::vector<std::string> const& users, std::vector<std::string> const& ours,
                                      std::string const& script) {
  std::vector<std::string> words{"sbatch", "--parsable"};
  words.insert(words.end(), users.begin(), users.end());
  words.insert(words.end(), ours.begin(), ours.end());
  // a name that begins with a dash is no option
  words.push_back(script.starts_with("-") ? "./" + script : script);
  return words;
}

void write_script(std::filesystem::path const& name, std::string const& text) {
  TempFile file(name);
  file.write_at(0, text.data(), text.size());
  file.publish();
}

// for a shell, in one line
std::string shell_line(std::vector<std::string> const& words) {
  std::string line;
  for (auto const& word : words) {
    bool const is_plain = std::all_of(word.begin(), word.end(), [](unsigned char c) {
      return std::isalnum(c) != 0 || std::string_view("-_=:,./@+").find(static_cast<char>(c)) != std::string_view::npos;
    });
    line += (line.empty() ? "" : " ") + (is_plain ? word : shell_word(word));
  }
  return line;
}

void queue(SlurmPlan const& plan, SubmitArguments const& arguments, std::string const& array_name,
           std::string const& merge_name, Session const& session) {
  std::string const see = "run this where Slurm is, or --dry-run to see the scripts, or jobs/slurm/*.sbatch to edit";
  write_script(array_name, array_script(plan));
  if (!plan.diagnoses) write_script(merge_name, merge_script(plan));
  Sbatch const first(sbatch_words(arguments.sbatch_options, {}, array_name));
  if (!first.was_started()) throw not_submitted("there is no sbatch here", see);
  std::string const array = first.number();
  if (array.empty()) throw not_submitted("sbatch did not take the job: its own words stand above", see);
  if (plan.diagnoses) {
    session.note(session.topic_line("queued", fmt::format("the diagnosis as job {}", array)));
  } else {
    auto const words = sbatch_words(arguments.sbatch_options, {"--dependency=afterok:" + array}, merge_name);
    std::string const merge = Sbatch(words).number();
    if (merge.empty())
      throw not_submitted(
          fmt::format("sbatch took the shards, as job {}, but not their merge: its words stand above", array),
          shell_line(words) + "; or scancel " + array);
    session.note(session.topic_line(
        "queued", fmt::format("{} shards as job {}, merge as job {} when all are done", plan.shards, array, merge)));
  }
  session.note(session.topic_line("look", "torquescope status " + plan.result));
}

// of a job without [[estimator]] and with [diagnose]
bool is_for_diagnose(std::string const& job) {
  Job const text = read_job(job);
  return text.all("estimator").empty() && text.find("diagnose") != nullptr;
}

ExitCode submit_job(SubmitArguments const& arguments, Session const& session) {
  // everything that can be refused is refused here and not in the queue
  SlurmPlan plan;
  plan.diagnoses = is_for_diagnose(arguments.job);
  Experiment const experiment =
      Experiment::load(arguments.job, plan.diagnoses ? Experiment::Purpose::diagnose : Experiment::Purpose::identify);
  std::filesystem::path const result =
      arguments.out.empty() ? experiment.output_file() : std::filesystem::path(arguments.out);
  plan.program = this_program();
  plan.job = arguments.job;
  plan.result = result.string();
  plan.name = experiment.name();
  plan.shards = plan.diagnoses ? 1 : arguments.shards;  // a diagnosis is not divided
  plan.threads = std::max(1, arguments.threads);
  plan.time = arguments.time;
  plan.partition = arguments.partition;
  plan.save_every_s = arguments.save_every_s;
  if (!plan.diagnoses) plan.result_bytes = result_bytes(experiment.parts());
  check_plan(plan);
  refuse_long_name(result);
  refuse_foreign_folder(segment_folder_of(result));
  std::string const array_name = result.string() + ".array.sbatch", merge_name = result.string() + ".merge.sbatch";
  auto const kind = plan.diagnoses ? ResultKind::diagnosis : ResultKind::runs;
  if (!arguments.dry_run && already_complete(result, experiment.inputs_sha256(), kind)) {
    session.note(session.topic_line("done", result.string() + " is already complete: nothing is queued"));
    return ExitCode::ok;
  }
  if (!arguments.dry_run) {
    queue(plan, arguments, array_name, merge_name, session);
    return ExitCode::ok;
  }
  auto const& users = arguments.sbatch_options;
  std::string text = fmt::format("# {}\n{}", array_name, array_script(plan));
  if (!plan.diagnoses) text += fmt::format("\n# {}\n{}", merge_name, merge_script(plan));
  text += fmt::format("\n# {}\n", shell_line(sbatch_words(users, {}, array_name)));
  if (!plan.diagnoses)
    text += fmt::format("# {}\n", shell_line(sbatch_words(users, {"--dependency=afterok:ARRAY"}, merge_name)));
  session.result(text);
  return ExitCode::ok;
}

std::string no_shard_count(std::string const& text) {
  bool const fits = !text.empty() && text.size() <= 5 && text.front() != '0' &&
                    std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  return fits ? "" : fmt::format("\"{}\" is no number of shards from 1 to 99999", text);
}

// a value must not end its line and begin a command
std::string no_plain_word(std::string const& text) {
  bool const fits = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == ':' || c == '-' || c == '_' || c == ',' || c == '.';
  });
  return fits ? "" : fmt::format("\"{}\" holds letters that no Slurm option has", text);
}

// what stands behind "--": for sbatch, but for what `submit` says itself
std::string no_sbatch_option(std::string const& text) {
  if (!text.starts_with("-") || text == "-" || text == "--") return fmt::format("\"{}\" is no option of sbatch", text);
  for (std::string_view const ours : {"--array", "--dependency", "--wrap", "--parsable", "--output", "--cpus-per-task"})
    if (text == ours || text.starts_with(std::string(ours) + "="))
      return fmt::format("{} is for `submit` to say (--shards, --threads)", ours);
  for (std::string_view const ours : {"-a", "-d", "-o", "-c"})
    if (text.starts_with(ours)) return fmt::format("{} is for `submit` to say (--shards, --threads)", ours);
  bool const is_one_line = std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; });
  return is_one_line ? "" : "an option of sbatch has no control characters";
}

}  // namespace

void add_submit(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<SubmitArguments>();
  CLI::App* command = app.add_subcommand(
      "submit",
      "Hands a job, or a diagnosis, to Slurm: an array of shards that survives kills, and a merge when all are done.");
  command->footer(
      "  torquescope submit lab.toml --shards 8 --threads 4 --time 02:00:00\n"
      "  torquescope submit lab.toml --shards 8 --dry-run\n"
      "  torquescope submit lab.toml --shards 8 -- --account=robots --qos=long\n"
      "  torquescope status lab.h5\n");
  command->add_option("JOB.toml", arguments->job, "job file, TOML (torquescope list sections)")->required();
  command->add_option("OPTION", arguments->sbatch_options, "behind \"--\": for sbatch, as they are, --name=value")
      ->check(no_sbatch_option);
  add_result_option(*command, arguments->out);
  command
      ->add_option("--shards", arguments->shards,
                   "tasks of the array; each does its part of the runs, in minutes not seconds")
      ->type_name("N")
      ->required()
      ->check(no_shard_count)
      ->group("cluster");
  command->add_option("--time", arguments->time, "limit of one task; more is asked for by requeueing [02:00:00]")
      ->type_name("H:M:S")
      ->check(no_plain_word)
      ->group("cluster");
  command->add_option("--partition", arguments->partition, "where to run")
      ->type_name("NAME")
      ->check(no_plain_word)
      ->group("cluster");
  command->add_flag("--dry-run", arguments->dry_run, "print both scripts, submit nothing")->group("cluster");
  add_seconds_option(*command, "--save-every", arguments->save_every_s,
                     "seconds between two segments: what a kill may cost [20]");
  add_threads_option(*command, arguments->threads);
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return submit_job(*arguments, session); };
  });
}

}  // namespace torquescope
