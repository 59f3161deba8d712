#pragma once
// A job file as plain sections with places: what was written and where, not yet what it means.
//
// [experiment] becomes Section "experiment"; [simulate.plant] becomes "simulate.plant", as does plant = {...} inside
// [simulate]; each [[estimator]] becomes one Section "estimator". Only `columns`, inline or as [recording.columns], is
// a setting (of type map): what a table means follows from its name, never from the values that happen to be in it.
//
// Order      sections and settings stand in the order of the file
// Errors     read_job: Error 66 (no such file, or not a regular one)
//            parse_job: Error 78 with file:line:column: syntax, duplicate keys, dates, mixed lists, numbers that are
//            not finite, more than 1 MiB or 32 levels
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

  Section const* find(std::string const& name) const;              // the first of this name, or nullptr
  std::vector<Section const*> all(std::string const& name) const;  // in the order of the file
  std::filesystem::path resolve(std::string const& name) const;    // relative to the job file's folder
};

Job read_job(std::filesystem::path const& path);
Job parse_job(std::string text, std::filesystem::path const& path);

}  // namespace torquescope
