#pragma once
// Many recordings in one job: [[recordings]] by patterns over file names or by manifests, [known] beside them.
//
// Order      sections as the job has them, files of a pattern by name, rows of a manifest as they stand
// Torque     a set may have command and position alone: without columns.torque, Recording::torque is n zeros
// Faults     of a recording (Recording::findings) and its warnings stay in it; who calls decides
// Errors     read_recording_set: problems are appended; 78 the job, 66 no such file or nothing matches, 65 a manifest.
//            Entries are whole only where none was. read_recordings: throws, those of make_recording()
// Threads    free functions

#include <vector>

#include "engine/base/options.hpp"
#include "engine/data/recording.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/experiment/known_quantities.hpp"

namespace torquescope {

// the keys of [[recordings]] that are no quantities
struct RecordingsOptions {
  std::string files{}, manifest{};
  std::string role = "train";

  static OptionTable<RecordingsOptions> const& table();
};

struct SetRecording {
  SetEntry entry;
  Recording recording;
};

bool has_recording_set(Job const& job);

// reads the job's text, folders and manifests; no recording. Without [[recordings]] none
std::vector<SetEntry> read_recording_set(Job const& job, std::vector<Problem>& problems);

// one for each entry, in their order, as [recording] says, all at one rate (recordings_of_job.hpp)
std::vector<SetRecording> read_recordings(Job const& job, std::vector<SetEntry> const& entries);

}  // namespace torquescope
