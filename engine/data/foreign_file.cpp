#include "engine/data/foreign_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

#include "engine/data/data_problem.hpp"
#include "engine/data/delimited_text.hpp"

namespace torquescope {
namespace {

// {0}: the file in quotes of Python, {1}: the file of CSV in quotes of Python, {2}: its name for a shell
struct Export {
  std::string_view help;
  std::string_view line{};
};

constexpr Export ros_bag{"convert it with the Python package (in a clone of Torquescope: pip install '.[ros]'):",
                         "python3 -m torquescope convert {2} {2}.h5"};
constexpr Export lerobot{"convert it with the Python package (in a clone of Torquescope: pip install '.[lerobot]'):",
                         "python3 -m torquescope convert {2} {2}.h5"};
constexpr Export parquet{"export it as CSV (pip install pandas pyarrow):",
                         "python3 -c 'import pandas; pandas.read_parquet({0}).to_csv({1})'"};
constexpr Export feather{"export it as CSV (pip install pandas pyarrow):",
                         "python3 -c 'import pandas; pandas.read_feather({0}).to_csv({1})'"};
constexpr Export excel{"save it as CSV in the spreadsheet, or (pip install pandas openpyxl):",
                       "python3 -c 'import pandas; pandas.read_excel({0}).to_csv({1}, index=False)'"};
constexpr Export old_excel{"save it as CSV in the spreadsheet, or (pip install pandas xlrd):",
                           "python3 -c 'import pandas; pandas.read_excel({0}).to_csv({1}, index=False)'"};
constexpr Export pickle{"a pickle can run any program: if you trust it, export it as CSV (pip install pandas):",
                        "python3 -c 'import pandas; pandas.DataFrame(pandas.read_pickle({0})).to_csv({1})'"};
constexpr Export tdms{"export one group as CSV (pip install nptdms pandas):",
                      "python3 -c 'from nptdms import TdmsFile; TdmsFile.read({0}).groups()[0].as_dataframe()"
                      ".to_csv({1})'"};
constexpr Export mdf{"export it as CSV (pip install asammdf):",
                     "python3 -c 'from asammdf import MDF; MDF({0}).to_dataframe().to_csv({1})'"};
constexpr Export ulog{"export it as CSV, a file per topic (pip install pyulog):", "ulog2csv {2}"};
constexpr Export yaml{
    "echo the topic as CSV: ros2 topic echo --csv TOPIC > topic.csv, or rostopic echo -p TOPIC in ROS 1"};
constexpr Export unpack{"unpack it first and name what is in it"};
constexpr Export robot{"it describes a robot; name the file with the recorded rows of time, position and torque"};
constexpr Export job{"name the recording there, not the job: a file with rows of time, position and torque"};
constexpr Export no_numbers{"name the file with the recorded rows of time, position and torque"};
constexpr Export page{"was a page downloaded in place of the file? download the file itself"};
constexpr Export lfs{"fetch the file itself: git lfs pull"};

struct Kind {
  std::string_view magic;
  std::string_view is;
  Export const* way_out;
  std::size_t at = 0;
};

using namespace std::string_view_literals;

constexpr std::array kinds{
    Kind{"\x89MCAP0\r\n"sv, "an MCAP file", &ros_bag},
    Kind{"#ROSBAG V"sv, "a bag of ROS 1", &ros_bag},
    Kind{"SQLite format 3\0"sv, "a database of SQLite, as bags of ROS 2 are (.db3)", &ros_bag},
    Kind{"PAR1"sv, "a Parquet file", &parquet},
    Kind{"ARROW1"sv, "a Feather file", &feather},
    Kind{"FEA1"sv, "a Feather file", &feather},
    Kind{"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"sv, "a workbook of old Excel", &old_excel},
    Kind{"TDSm"sv, "a TDMS file of LabVIEW", &tdms},
    Kind{"MDF     "sv, "an MDF file", &mdf},
    Kind{"ULog\x01\x12\x35"sv, "a ULog file of PX4", &ulog},
    Kind{"\x80\x02"sv, "a pickle of Python", &pickle},
    Kind{"\x80\x03"sv, "a pickle of Python", &pickle},
    Kind{"\x80\x04"sv, "a pickle of Python", &pickle},
    Kind{"\x80\x05"sv, "a pickle of Python", &pickle},
    Kind{"BZh"sv, "packed by bzip2", &unpack},
    Kind{"\xfd"
         "7zXZ\0"sv,
         "packed by xz", &unpack},
    Kind{"\x28\xb5\x2f\xfd"sv, "packed by zstd", &unpack},
    Kind{"7z\xbc\xaf\x27\x1c"sv, "packed by 7-Zip", &unpack},
    Kind{"Rar!\x1a\x07"sv, "packed by RAR", &unpack},
    Kind{"ustar"sv, "a tar archive", &unpack, 257},
    Kind{"%PDF-"sv, "a PDF document", &no_numbers},
    Kind{"\x89PNG\r\n"sv, "a picture (PNG)", &no_numbers},
    Kind{"\xff\xd8\xff"sv, "a picture (JPEG)", &no_numbers},
    Kind{"version https://git-lfs.github.com/spec"sv, "a pointer of Git LFS, not the file", &lfs},
    Kind{"\x7f"
         "ELF"sv,
         "a program", &no_numbers},
};

std::string_view trimmed_front(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  auto const first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

bool holds(std::string_view text, std::string_view word) { return text.find(word) != std::string_view::npos; }

// in double quotes of Python, inside single quotes of a shell
std::string python_text(std::string const& text) {
  std::string quoted = "\"";
  for (char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter == '\'' ? "'\\''" : std::string(1, letter);
  }
  return quoted + "\"";
}

bool is_plain(std::string const& text) {
  return std::all_of(text.begin(), text.end(), [](char letter) {
    return std::string_view("/._-+=,:@%~").find(letter) != std::string_view::npos || (letter >= '0' && letter <= '9') ||
           (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
  });
}

std::string shell_text(std::string const& text) {
  if (is_plain(text)) return text;
  std::string quoted = "'";
  for (char letter : text) quoted += letter == '\'' ? "'\\''" : std::string(1, letter);
  return quoted + "'";
}

Problem problem_of(std::filesystem::path const& path, std::string_view is, Export const& way_out) {
  auto problem = bad_data(fmt::format("{} is {}", path.string(), is), path.string(), 0, std::string(way_out.help));
  if (way_out.line.empty()) return problem;
  auto csv = path;
  csv += ".csv";
  problem.notes.push_back("    " + fmt::format(fmt::runtime(way_out.line), python_text(path.string()),
                                               python_text(csv.string()), shell_text(path.string())));
  return problem;
}

// text that is no table
std::optional<Problem> foreign_text(std::filesystem::path const& path, std::string_view bytes) {
  auto const text = trimmed_front(bytes);
  auto const lower = lower_case(text.substr(0, 1000));
  auto const first_line = std::string_view(lower).substr(0, lower.find('\n'));
  if (lower.starts_with("<!doctype html") || lower.starts_with("<html")) return problem_of(path, "a web page", page);
  if (lower.starts_with("<?xml") || lower.starts_with("<robot") || lower.starts_with("<mujoco") ||
      lower.starts_with("<sdf"))
    return problem_of(path, holds(lower, "<robot") ? "a URDF file" : "an XML file", robot);
  for (std::string_view section : {"[experiment]", "[recording]", "[model]", "[[estimator]]", "[filter]"})
    if (first_line.starts_with(section)) return problem_of(path, "a job of Torquescope", job);
  bool const is_echo = lower.starts_with("header:") && holds(lower, "stamp:");
  if (is_echo) return problem_of(path, "the echo of a ROS topic as YAML", yaml);
  return std::nullopt;
}

}  // namespace

std::optional<Problem> foreign_file(std::filesystem::path const& path, std::string_view first_bytes) {
  for (auto const& kind : kinds)
    if (first_bytes.size() > kind.at && first_bytes.substr(kind.at).starts_with(kind.magic))
      return problem_of(path, kind.is, *kind.way_out);
  return foreign_text(path, first_bytes);
}

std::optional<Problem> foreign_folder(std::filesystem::path const& path) {
  std::error_code unknown;
  if (!std::filesystem::is_directory(path, unknown)) return std::nullopt;
  if (std::filesystem::exists(path / "meta" / "info.json", unknown))
    return problem_of(path, "a folder with a data set of LeRobot", lerobot);
  if (!std::filesystem::exists(path / "metadata.yaml", unknown)) return std::nullopt;
  return problem_of(path, "a folder with a bag of ROS 2", ros_bag);
}

Problem foreign_zip(std::filesystem::path const& path, ZipArchive const& archive) {
  auto const has = [&](std::string_view begin) {
    return std::any_of(archive.members().begin(), archive.members().end(),
                       [&](auto const& member) { return member.name.starts_with(begin); });
  };
  if (has("xl/")) return problem_of(path, "a workbook of Excel", excel);
  if (has("content.xml")) return problem_of(path, "a document of LibreOffice", excel);
  return problem_of(path, "a zip file without arrays of numpy", unpack);
}

}  // namespace torquescope
