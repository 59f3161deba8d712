#include "engine/app/report/child_program.hpp"

#include <fcntl.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): SIGKILL for prctl
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <mutex>
#include <string_view>

#include "engine/base/fork_guard.hpp"
#include "engine/base/interrupted_call.hpp"

extern char** environ;

namespace torquescope {
namespace {

constexpr std::string_view one_thread = "OPENBLAS_NUM_THREADS=1";

std::vector<std::string> environment_of_child() {
  std::vector<std::string> variables{std::string(one_thread)};
  std::string_view const name = one_thread.substr(0, one_thread.find('=') + 1);
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (!std::string_view(*variable).starts_with(name)) variables.emplace_back(*variable);
  return variables;
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// in the child: nothing but system calls between fork and exec
[[noreturn]] void become(char* const* arguments, char* const* variables, Voice voice, rlim_t seconds, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // it ended before it could be heard of
  // who takes no notice of the first signal is killed
  constexpr rlim_t patience_s = 5;
  rlimit const time{seconds, seconds + patience_s}, no_core{0, 0};
  ::setrlimit(RLIMIT_CPU, &time);
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (voice == Voice::silent) {
    int const nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  } else {
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  ::execvpe(arguments[0], arguments, variables);
  ::_exit(127);
}

}  // namespace

ProgramEnd run_program(std::vector<std::string> arguments, Voice voice, int processor_seconds) {
  auto variables = environment_of_child();
  auto const argument_pointers = pointers_to(arguments), variable_pointers = pointers_to(variables);
  pid_t const parent = ::getpid();
  pid_t child = -1;
  {
    std::lock_guard const alone(fork_guard());
    child = ::fork();
    if (child == 0)
      become(argument_pointers.data(), variable_pointers.data(), voice, static_cast<rlim_t>(processor_seconds), parent);
  }
  if (child < 0) return {};
  int status = 0;
  if (unless_interrupted([&] { return ::waitpid(child, &status, 0); }) < 0) return {};
  if (WIFEXITED(status)) return {.status = WEXITSTATUS(status)};
  return {.used_up_its_time = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU};
}

}  // namespace torquescope
