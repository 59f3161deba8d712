#pragma once
// A job file as plain sections with places: what was written and where, not yet what it means.
//
// [experiment] becomes Section "experiment"; [simulate.plant] becomes "simulate.plant"; each [[estimator]] becomes one
// Section "estimator". A table inside a section ({time = "t_s"} or [recording.columns]) with only texts as values is a
// setting of type map; a nested table with anything else is a section of its own.
//
// Errors     read_job: Error 66 (no such file), 78 (syntax, size, nesting, duplicate keys: file:line:column), 1 MiB at most
// Threads    plain record

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/options.hpp"

namespace torquescope {

struct Job {
  std::filesystem::path path;  // as the user gave it; paths inside the job are relative to its folder
  std::string text;            // verbatim
  std::string sha256;          // of the text
  std::vector<Section> sections;

  Section const* find(std::string const& name) const;               // the first of this name, or nullptr
  std::vector<Section const*> all(std::string const& name) const;   // in the order of the file
  std::filesystem::path resolve(std::string const& name) const;     // relative to the job file's folder
};

Job read_job(std::filesystem::path const& path);
Job parse_job(std::string text, std::filesystem::path const& path);

}  // namespace torquescope
