#pragma once
// Ctrl-C and friends: the first asks the run to stop after its generation, the second ends the process at once.
//
// Signals    SIGINT, SIGTERM, SIGUSR1, SIGXCPU, SIGHUP; SIGPIPE and SIGXFSZ are ignored, so that writing reports them
// Exit       75 by way of stop_requested(); 128 + signal number on the second one (130 for Ctrl-C)
// Threads    stop_requested() from any thread

namespace torquescope {

enum class StopNotice { spoken, silent };  // silent: --quiet

void install_stop_signals(StopNotice notice);
void ignore_write_signals();  // SIGPIPE, SIGXFSZ: for every command
bool stop_requested();

}  // namespace torquescope
