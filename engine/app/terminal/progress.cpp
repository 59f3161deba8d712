#include "engine/app/terminal/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "engine/app/terminal/environment.hpp"
#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {

namespace {

constexpr double redraw_seconds = 0.1;
constexpr double line_seconds = 60.0;
constexpr double estimate_after_seconds = 2.0;
constexpr double patient_seconds = 2.0, patient_stage_seconds = 10.0;
constexpr double beat_seconds = 0.4;

bool is_done(ProgressUpdate const& update) { return update.runs_total > 0 && update.runs_done >= update.runs_total; }

// "1.9 M", "850", "12 k"
std::string short_rate(double rate) {
  char const* unit = "";
  for (char const* next : {" k", " M", " G"}) {
    if (rate < 999.5) break;
    rate /= 1000.0;
    unit = next;
  }
  return rate < 9.95 ? fmt::format("{:.1f}{}", rate, unit) : fmt::format("{:.0f}{}", rate, unit);
}

std::string clock_text(double seconds) {
  auto const whole = static_cast<std::int64_t>(std::ceil(seconds));
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

ProgressStyle progress_style(ProgressChoice choice, ProgressFacts const& facts) {
  if (facts.quiet || choice == ProgressChoice::none) return ProgressStyle::none;
  if (choice == ProgressChoice::lines) return ProgressStyle::lines;
  // a bar in a file is rubbish, also when it was asked for
  bool const can_redraw = facts.stderr_is_terminal && !facts.dumb;
  if (choice == ProgressChoice::bar) return can_redraw ? ProgressStyle::bar : ProgressStyle::lines;
  return can_redraw && !facts.batch_job ? ProgressStyle::bar : ProgressStyle::lines;
}

ProgressFacts progress_facts(bool quiet) {
  bool const batch = !environment("SLURM_JOB_ID").empty() || !environment("CI").empty();
  return {is_terminal(STDERR_FILENO), environment("TERM") == "dumb", batch, quiet};
}

double share_done(ProgressUpdate const& update) {
  if (is_done(update)) return 1.0;
  bool const counted = update.evaluations_total > 0;
  auto const done = static_cast<double>(counted ? update.evaluations_done : update.runs_done);
  auto const total = static_cast<double>(counted ? update.evaluations_total : update.runs_total);
  // all evaluations told is not yet all runs handed over: only is_done() is the whole
  return total > 0.0 ? std::clamp(done / total, 0.0, 0.999) : 0.0;
}

std::optional<double> seconds_left(ProgressUpdate const& update) {
  if (update.seconds < estimate_after_seconds || is_done(update)) return std::nullopt;
  bool const by_runs = update.runs_done > 0 && update.runs_total > 0;
  auto const done = static_cast<double>(by_runs ? update.runs_done : update.evaluations_done);
  auto const total = static_cast<double>(by_runs ? update.runs_total : update.evaluations_total);
  if (done <= 0.0 || total <= 0.0) return std::nullopt;
  return update.seconds * std::max(0.0, total - done) / done;
}

std::optional<double> seconds_left_in_all(ProgressUpdate const& update, double seconds_in_all) {
  double const left = update.expected_seconds - seconds_in_all;
  if (seconds_in_all < estimate_after_seconds || left < 1.0) return std::nullopt;
  return left;
}

std::string progress_line(ProgressUpdate const& update, double seconds_in_all) {
  std::string line =
      fmt::format("progress stage={} runs={}/{}", printable(update.stage), update.runs_done, update.runs_total);
  if (update.evaluations_total > 0)
    line += fmt::format(" evals={}/{}", update.evaluations_done, update.evaluations_total);
  auto const left = seconds_left_in_all(update, seconds_in_all);
  if (auto const known = left ? left : seconds_left(update)) line += fmt::format(" eta_s={:.0f}", std::ceil(*known));
  return line + "\n";
}

std::string progress_bar(ProgressUpdate const& update, int width, bool utf8) {
  std::string const lead = pad_right(printable(update.stage), 8) + " ";
  std::string tail = fmt::format("  {}/{} {}", update.runs_done, update.runs_total, update.counted);
  if (update.seconds > 0.0 && update.evaluations_done > 0)
    tail += fmt::format("   {} eval/s", short_rate(static_cast<double>(update.evaluations_done) / update.seconds));
  if (auto const left = seconds_left(update)) tail += fmt::format("   {} left", clock_text(*left));

  int const room = width - 1 - columns_of(lead) - columns_of(tail);
  int const cells = std::clamp(room, 0, 32);
  int const full = static_cast<int>(share_done(update) * cells);
  std::string bar;
  for (int i = 0; i < cells; ++i) bar += i < full ? (utf8 ? "█" : "#") : (utf8 ? "░" : "-");
  std::string text = lead + bar + tail;
  // a very narrow window: the words that fit
  if (columns_of(text) > width - 1) text = wrap(text, width - 1, width - 1).front();
  return columns_of(text) > width - 1 ? "" : text;
}

std::string waiting_bar(ProgressUpdate const& update, double seconds_in_all, int width, bool utf8) {
  constexpr double columns_per_second = 4.0, worth_saying = 1.0;
  constexpr int block = 4;
  std::string const lead = pad_right(printable(update.stage), 8) + " ";
  std::string tail = update.runs_total > 0 ? fmt::format("  {} {}", update.runs_total, update.counted) : std::string();
  tail += "   " + clock_text(std::floor(update.seconds));
  if (seconds_in_all > update.seconds + worth_saying)
    tail += fmt::format(", {} in all", clock_text(std::floor(seconds_in_all)));
  if (auto const left = seconds_left_in_all(update, seconds_in_all))
    tail += fmt::format(", about {} left", clock_text(*left));
  int const cells = std::clamp(width - 1 - columns_of(lead) - columns_of(tail), 0, 32);
  int const turn = std::max(1, 2 * (cells - block));
  int const step = static_cast<int>(std::fmod(update.seconds * columns_per_second, turn));
  int const first = std::min(step, turn - step);  // to the right and back
  std::string bar;
  for (int i = 0; i < cells; ++i) bar += i >= first && i < first + block ? (utf8 ? "█" : "#") : (utf8 ? "░" : "-");
  std::string text = lead + bar + tail;
  if (columns_of(text) > width - 1) text = wrap(text, width - 1, width - 1).front();
  return columns_of(text) > width - 1 ? "" : text;
}

ProgressPrinter::ProgressPrinter(Settings settings) : settings_(std::move(settings)) {
  began_ = told_ = settings_.clock ? settings_.clock() : 0.0;
  last_time_ = began_;
}

void ProgressPrinter::operator()(ProgressUpdate const& update) {
  if (settings_.style == ProgressStyle::none) return;
  std::lock_guard const lock(guard_);
  waits_ = false;
  if (update.stage != stage_) {
    erase_bar();
    stage_ = update.stage;
    last_tenth_ = -1;
    if (!settings_.patient || settings_.style == ProgressStyle::bar) last_time_ = -line_seconds;
  }
  last_ = update;
  told_ = settings_.clock();
  if (settings_.style == ProgressStyle::lines) {
    print_line(update);
  } else {
    draw_bar(update);
  }
}

void ProgressPrinter::wait_for(std::string const& stage) {
  constexpr double before_a_bar = 1.0;
  if (settings_.style == ProgressStyle::none) return;
  std::lock_guard const lock(guard_);
  erase_bar();
  stage_ = stage;
  last_ = {};
  last_.stage = stage;
  last_.seconds = before_a_bar - beat_seconds;
  began_ = settings_.clock();
  last_time_ = began_;
  told_ = began_ + before_a_bar - beat_seconds;
  waits_ = true;
  waited_ = false;
}

void ProgressPrinter::beat() {
  if (settings_.style == ProgressStyle::none) return;
  std::lock_guard const lock(guard_);
  double const now = settings_.clock();
  if (stage_.empty() || now - told_ < beat_seconds) return;
  ProgressUpdate update = last_;
  update.seconds = std::max(0.0, update.seconds + now - told_);
  if (settings_.style == ProgressStyle::lines) {
    if (waits_ && !waited_) {
      waited_ = true;
      last_time_ = now;
      settings_.write(fmt::format("progress stage={} seconds={:.0f}\n", printable(stage_), now - began_));
    } else if (now - last_time_ >= line_seconds) {
      print_line(update);
    }
    return;
  }
  bool const counts = update.evaluations_done > 0 || (update.runs_done > 0 && !is_done(update));
  draw(counts ? progress_bar(update, settings_.width(), settings_.utf8)
              : waiting_bar(update, now - began_, settings_.width(), settings_.utf8));
}

void ProgressPrinter::print_line(ProgressUpdate const& update) {
  int const tenth = static_cast<int>(share_done(update) * 10.0);
  double const now = settings_.clock();
  if (settings_.patient && update.seconds < patient_seconds &&
      !(is_done(update) && now - last_time_ >= patient_stage_seconds))
    return;
  if (tenth <= last_tenth_ && now - last_time_ < line_seconds) return;
  last_tenth_ = std::max(tenth, last_tenth_);
  last_time_ = now;
  settings_.write(progress_line(update, now - began_));
}

void ProgressPrinter::draw_bar(ProgressUpdate const& update) {
  if (is_done(update)) return erase_bar();
  double const now = settings_.clock();
  if (now - last_time_ < redraw_seconds) return;
  last_time_ = now;
  draw(progress_bar(update, settings_.width(), settings_.utf8));
}

void ProgressPrinter::draw(std::string const& bar) {
  // spaces instead of an escape sequence wipe what a longer bar left behind
  settings_.write("\r" + pad_right(bar, std::min(drawn_columns_, settings_.width() - 1)));
  drawn_columns_ = columns_of(bar);
}

void ProgressPrinter::erase() {
  std::lock_guard const lock(guard_);
  erase_bar();
}

void ProgressPrinter::erase_bar() {
  if (drawn_columns_ == 0) return;
  int const columns = std::min(drawn_columns_, settings_.width() - 1);
  settings_.write("\r" + std::string(static_cast<std::size_t>(columns), ' ') + "\r");
  drawn_columns_ = 0;
}

}  // namespace torquescope
