#pragma once
// Ctrl-C and friends: the first asks the work to stop after its present step; a second Ctrl-C ends the process at once.
//
// Signals    SIGINT, SIGTERM, SIGUSR1, SIGXCPU, SIGHUP; SIGPIPE and SIGXFSZ are ignored, so that writing reports them.
//            SIGCONT is none: Slurm sends it along with SIGTERM. A batch system sends several signals in a row, so only
//            Ctrl-C twice means "at once"
// Exit       75 by way of stop_requested(); 75 at the latest after four seconds, whatever is being computed (segments
//            on the disk are safe then, the rest is not), unless saving_begins() has said that the rest is on its way:
//            this is said always; 130 on the second Ctrl-C. Either way the job's lock is taken away
// Budget     stop_after() makes a time budget one more reason to stop
// Threads    stop_requested() from any thread

#include <string>

namespace torquescope {

enum class StopNotice { spoken, silent };  // of the first signal; silent: --quiet

// what a signal handler prints: literals
struct StopWords {
  char const* at_first;   // after what it will stop
  char const* cut_short;  // after four seconds
};
inline constexpr StopWords words_of_runs{
    "stopping after the running generation",
    "stopped in the middle of a generation that takes long; the same command goes on from its last segment"};

void install_stop_signals(StopNotice notice, StopWords const& words = words_of_runs);
void ignore_write_signals();  // SIGPIPE, SIGXFSZ: for every command
// of the time since the process began; what is done is saved a tenth of it, but at most a minute, before its end
void stop_after(double seconds);
bool stop_requested();
std::string stop_words();  // by what: "SIGTERM", "time budget (3600 s)"
void saving_begins();

}  // namespace torquescope
