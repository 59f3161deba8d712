#pragma once
// Files that are no recording of a kind read here, told by their first bytes, with the line that exports their numbers.
//
// Known      recordings of robots (ROS bags, MCAP, ULog), tables (Parquet, Excel, Feather, pickle, LabVIEW TDMS, MDF),
//            packed files, and what is no recording at all (URDF, pictures, PDF, web pages, pointers of Git LFS)
// Threads    functions of their arguments

#include <filesystem>
#include <optional>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/data/zip_archive.hpp"

namespace torquescope {

// nothing: not told apart by its first bytes
std::optional<Problem> foreign_file(std::filesystem::path const& path, std::string_view first_bytes);
// a bag of ROS 2 is a folder; nothing: any other folder
std::optional<Problem> foreign_folder(std::filesystem::path const& path);
// a zip file without arrays of numpy
Problem foreign_zip(std::filesystem::path const& path, ZipArchive const& archive);

}  // namespace torquescope
