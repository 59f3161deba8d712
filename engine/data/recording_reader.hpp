#pragma once
// From a file to a checked Recording: reader by content, columns by the job's mapping, torque_per_unit, delay, gaps.
//
// Errors     Error with exit code 66 (no such file), 65 (damaged or contradicting data: NaN, backwards time, constant
//            signal, repeated header), 78 (a column the job names is not in the file), each with the way out
// Source     formats: docs in readers/*.cpp

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/data/recording.hpp"

namespace torquescope {

struct RecordingOptions {
  std::vector<std::string> train{};
  std::vector<std::string> validate{};
  std::map<std::string, std::string>
      columns{};  // channel -> column: time, position, torque, reference, velocity, acceleration, and input_channels()
  std::map<std::string, std::string> clocks{};  // channel -> its own time column, where it is not columns.time
  // N m per unit of the torque column (A, V, N): of the joint, or of each joint of an arm
  std::vector<double> torque_per_unit{1.0};
  double position_per_unit = 1.0;                 // rad per unit of position, reference, velocity, acceleration columns
  double velocity_per_unit = 0.0;                 // rad/s per unit of the velocity column; 0: position_per_unit
  double time_per_unit = 1.0;                     // s per unit of the time column
  double wrap = 0.0;                              // modulus of the position column; 0: found from the recording
  std::map<std::string, std::string> encoding{};  // channel -> "unsigned16", "sign_magnitude", "plain"
  std::vector<double> leave_out{};                // s from, until, from, until, ...: on the recording's own clock
  double rate_hz = 0.0;                           // sampling rate when the file has no time column
  std::vector<double> delay_s{0.0};  // added to the torque's time stamps: of the joint, or of each of an arm
  std::string gaps = "fill";         // missing values: "error", or "fill" short ones and leave out longer ones
  std::string simulated_torque{};    // column of the user's own simulator, in N m (not scaled, not delayed)
  std::string simulated_position{};  // and of its position, from the reference, in the unit of the position column
  double train_share = 1.0;          // of every training recording, from its start; the rest judges
  // of an arm, kg: what its last link carries in each recording; none: nothing. First moments: three a recording
  std::vector<double> payload_kg{}, payload_first_moments_kgm{}, validate_payload_kg{};

  // of an arm, of each joint or one for all: -1 turns position and torque round; added to the position, rad or m
  std::vector<double> joint_sign{1.0}, zero{0.0};
  // of an arm: numbers, from 1, of the joint whose column each joint has; empty: its own
  std::vector<double> position_order{}, torque_order{};
  std::string torque_at = "joints";  // of an arm with coupled drives: or "motors"
  // of an arm: columns of force (N) and moment (N m) at its tip; about which axes, and on whom they act
  std::vector<std::string> wrench{};
  std::string wrench_frame = "tip", wrench_on = "arm";

  double delay() const { return delay_s.front(); }
  double torque_factor() const { return torque_per_unit.front(); }
  double velocity_factor() const { return velocity_per_unit != 0.0 ? velocity_per_unit : position_per_unit; }

  static OptionTable<RecordingOptions> const& table();
};

// a column that is in the file but cannot serve as a signal: text in a cell, another length, another type
struct UnusableColumn {
  std::string name;
  std::string reason;     // continues the name: "holds text: \"off\" in line 12"
  std::int64_t line = 0;  // where, in text formats
};

// channels of columns{} that only a simulation of the recording uses; a file without such a column has none of it
std::vector<std::string> const& input_channels();

// what any reader makes of a file: named columns of equal length
struct RawTable {
  std::string path;
  std::string sha256;
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  // empty cells and "nan" are NaN
  std::vector<std::int64_t> line_of_row{};   // text formats: line in the file of each row; else empty
  std::vector<UnusableColumn> unusable{};    // an error only if the job names one of them
  std::vector<std::string> units{};          // as the file writes them, one per column ("rad/s", ""); or none at all
  std::vector<std::string> remarks{};        // sentences: what the reader did on its own
  bool has_merged_clocks = false;            // rows of several clocks in turn (own_clocks.hpp)
  // of a file whose signals have several lengths, each with a clock: per column the values it has (NaN stands behind
  // them) and its clock; else empty (block_lengths.hpp)
  std::vector<std::size_t> lengths{};
  std::vector<std::string> clocks{};
};

// one per file in readers/; chosen by content, never by extension
struct ReaderChoice {
  std::string name;     // "csv"
  std::string meaning;  // "comma-separated text, plain or gzip"
  bool (*accepts)(std::filesystem::path const&, std::string const& first_bytes);
  RawTable (*read)(std::filesystem::path const&);  // in this process
  std::string library{};                           // "HDF5": not ours, so read_table() confines it
};
std::vector<ReaderChoice> const& reader_choices();

RawTable read_table(std::filesystem::path const& path, Section const& section);

}  // namespace torquescope
