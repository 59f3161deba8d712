#pragma once
// How far a run is: one line redrawn on a terminal, or plain lines that a program and a log can read.
//
// Bar        at most 10 times a second, time left after 2 s, erased when the stage is done; no escape sequences; a
//            stage that counts nothing meanwhile has a block that wanders, and the time since it began
// Lines      the first at once, then one per 10 % or 60 s: progress stage=fade runs=20/30 evals=60000/90000 eta_s=4
//            a wait of more than a second: progress stage=read seconds=1
//            patient (nobody asked for them): none in the first 2 s of a stage, but one where a stage ends and the last
//            line is 10 s old
// Threads    any

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "engine/experiment/progress_update.hpp"

namespace torquescope {

enum class ProgressChoice { automatic, bar, lines, none };
enum class ProgressStyle { none, lines, bar };

struct ProgressFacts {
  bool stderr_is_terminal = false;
  bool dumb = false;       // TERM=dumb
  bool batch_job = false;  // SLURM_JOB_ID or CI is set
  bool quiet = false;
};
ProgressStyle progress_style(ProgressChoice choice, ProgressFacts const& facts);
ProgressFacts progress_facts(bool quiet);  // of this process

// share of the stage that is done, 0 .. 1: by evaluations, or by runs where they are not counted
double share_done(ProgressUpdate const& update);
// seconds left, from completed runs, before the first from evaluations; nothing in the first 2 s
std::optional<double> seconds_left(ProgressUpdate const& update);
// of all stages, where somebody estimated them and they do not take longer
std::optional<double> seconds_left_in_all(ProgressUpdate const& update, double seconds_in_all);

// ends with a line feed; `seconds_in_all` since the command's first stage began
std::string progress_line(ProgressUpdate const& update, double seconds_in_all = 0.0);
std::string progress_bar(ProgressUpdate const& update, int width, bool utf8);  // at most width - 1 columns, one line
// of a stage that counts nothing meanwhile; `seconds_in_all` since the command's first stage began
std::string waiting_bar(ProgressUpdate const& update, double seconds_in_all, int width, bool utf8);

class ProgressPrinter {
 public:
  using Clock = std::function<double()>;  // seconds, monotone
  struct Settings {
    ProgressStyle style = ProgressStyle::none;
    std::function<void(std::string const&)> write{};
    std::function<int()> width{};
    Clock clock{};
    bool utf8 = false;
    bool patient = false;
  };
  explicit ProgressPrinter(Settings settings);
  ~ProgressPrinter() { erase(); }
  ProgressPrinter(ProgressPrinter const&) = delete;
  ProgressPrinter& operator=(ProgressPrinter const&) = delete;

  void operator()(ProgressUpdate const& update);
  // a stage that counts nothing begins: it is shown when it lasts
  void wait_for(std::string const& stage);
  void beat();   // nothing new was told: shows that time goes by
  void erase();  // leaves no trace of the bar

 private:
  void erase_bar();
  void draw(std::string const& bar);
  void print_line(ProgressUpdate const& update);
  void draw_bar(ProgressUpdate const& update);

  Settings settings_;
  std::mutex guard_;
  ProgressUpdate last_{};
  double began_ = 0.0, told_ = 0.0;  // of the clock: the first update, the last one
  std::string stage_{};
  bool waits_ = false, waited_ = false;  // wait_for() was the last word; a line has said so
  double last_time_ = 0.0;
  int last_tenth_ = -1;
  int drawn_columns_ = 0;
};

}  // namespace torquescope
