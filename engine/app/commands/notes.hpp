#pragma once
// What a command that computes says on stderr around its results: what it starts with, and where its file stands.

#include <filesystem>
#include <string>

#include "engine/app/session.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

// reads the job and its recordings; a bar stands there when that takes longer than a second
Experiment load_with_bar(Session const& session, std::filesystem::path const& job, Experiment::Purpose purpose);

// job, data, threads and warnings, before anything runs; job_line is the command's own line of the experiment
void note_start(Session const& session, std::string const& job_line, Experiment const& experiment,
                ThreadChoice const& threads);

// "wrote  R.h5  3.1 MB" and the command that shows it; word: "wrote" or "kept". Where `json` is the name of a file and
// not the sign of a stream, it stands beside
void note_whereabouts(Session const& session, std::string const& word, std::filesystem::path const& file,
                      std::string const& json = {});

// once a result stands: takes away what it was made of (remove_segments), and warns of what is left
void tidy_up(Session const& session, std::filesystem::path const& result, std::string const& inputs_sha256);

}  // namespace torquescope
