#include "engine/python/work.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "engine/app/failure.hpp"
#include "engine/app/result/finished_result.hpp"
#include "engine/experiment/diagnosis_estimate.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

struct Work::State {
  explicit State(WorkOrder order_) : order(std::move(order_)) {}

  WorkOrder const order;
  std::atomic<bool> must_stop{false};
  std::mutex mutable mutex{};
  std::condition_variable ended_now{};
  bool ended = false;
  std::exception_ptr failure{};
  ProgressUpdate progress{};
  std::vector<Message> messages{};

  void tell(std::string const& topic, std::string const& text) {
    std::lock_guard const lock(mutex);
    messages.emplace_back(topic, text);
  }
  void show(ProgressUpdate const& update) {
    std::lock_guard const lock(mutex);
    progress = update;
  }

  void run();
  void diagnose_job(Experiment const& experiment);
  void identify_job(Experiment experiment);
};

namespace {

void tell_findings(Experiment const& experiment,
                   std::function<void(std::string const&, std::string const&)> const& tell) {
  for (auto const& line : experiment.warnings()) tell("warning", line);
  for (auto const& line : experiment.remarks()) tell("note", line);
}

}  // namespace

void Work::State::diagnose_job(Experiment const& experiment) {
  DiagnoseRequest request;
  request.threads = choose_threads(order.threads);
  request.output = order.output;
  request.stop_requested = [this] { return must_stop.load(); };
  request.tell = [this](std::string const& topic, std::string const& text) { tell(topic, text); };
  request.expected_seconds = estimate_diagnosis(diagnosis_size(experiment.parts()), request.threads.count).seconds;
  diagnose(experiment, request, [this](ProgressUpdate const& update) { show(update); });
}

void Work::State::identify_job(Experiment experiment) {
  IdentifyOptions options;
  options.threads = choose_threads(order.threads);
  options.output = order.output;
  options.stop_requested = [this] { return must_stop.load(); };
  options.stop_words = [] { return std::string("KeyboardInterrupt"); };
  options.tell = [this](std::string const& topic, std::string const& text) { tell(topic, text); };
  identify(std::move(experiment), options, [this](ProgressUpdate const& update) { show(update); });
}

void Work::State::run() {
  bool const diagnoses = order.kind == WorkKind::diagnose;
  auto const purpose = diagnoses ? Experiment::Purpose::diagnose : Experiment::Purpose::identify;
  Experiment experiment = Experiment::load(read_source(order.job), purpose, order.tables);
  tell_findings(experiment, [this](auto const& topic, auto const& text) { tell(topic, text); });
  ResultKind const kind = diagnoses ? ResultKind::diagnosis : ResultKind::runs;
  if (already_complete(order.output, experiment.inputs_sha256(), kind)) {
    tell("done", "nothing runs again: the result of this job on these recordings is kept");
    return;
  }
  if (diagnoses)
    diagnose_job(experiment);
  else
    identify_job(std::move(experiment));
}

Work::Work(WorkOrder order) : state_(std::make_shared<State>(std::move(order))) {
  std::thread([state = state_] {
    std::exception_ptr failure;
    try {
      state->run();
    } catch (...) {
      failure = std::current_exception();
    }
    std::lock_guard const lock(state->mutex);
    state->failure = failure;
    state->ended = true;
    state->ended_now.notify_all();
  }).detach();
}

Work::~Work() { stop(); }

bool Work::wait(double seconds) const {
  std::unique_lock lock(state_->mutex);
  return state_->ended_now.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return state_->ended; });
}

void Work::stop() { state_->must_stop.store(true); }

ProgressUpdate Work::progress() const {
  std::lock_guard const lock(state_->mutex);
  return state_->progress;
}

std::vector<Work::Message> Work::take_messages() {
  std::lock_guard const lock(state_->mutex);
  return std::exchange(state_->messages, {});
}

void Work::finish() const {
  std::exception_ptr failure;
  {
    std::lock_guard const lock(state_->mutex);
    failure = state_->failure;
  }
  if (failure) throw Error(problems_of(failure));
}

}  // namespace torquescope
