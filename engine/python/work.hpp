#pragma once
// A run or a diagnosis in a thread of its own, so that whoever waits can show progress, and stop it.
//
// Begins     when made. A result that stands already, of this job on these recordings, is kept, as by the program
// Stops      at the next question of the workflow: once a generation, a replicate, an effect
// Destroyed  while it works: it is asked to stop and goes on alone until it has; nothing of Python is touched there
// Threads    one caller; the work itself takes the threads it is given

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/data/recorded_tables.hpp"
#include "engine/experiment/progress_update.hpp"
#include "engine/python/job_source.hpp"

namespace torquescope {

enum class WorkKind { identify, diagnose };

struct WorkOrder {
  WorkKind kind = WorkKind::diagnose;
  JobSource job{};
  RecordedTables tables{};
  std::filesystem::path output{};  // of the result
  int threads = 0;                 // 0: as the program chooses
};

class Work {
 public:
  using Message = std::pair<std::string, std::string>;  // topic, text

  explicit Work(WorkOrder order);
  ~Work();
  Work(Work const&) = delete;
  Work& operator=(Work const&) = delete;

  bool wait(double seconds) const;  // whether it has ended
  void stop();
  ProgressUpdate progress() const;  // the last there was
  std::vector<Message> take_messages();
  // Requires   it has ended. Errors: whatever ended it, as Error
  void finish() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace torquescope
