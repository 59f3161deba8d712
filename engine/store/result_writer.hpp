#pragma once
// Writes one result file (RESULT_FORMAT.md); under its final name it is complete or it is not there.
//
// Use        ResultWriter writer("R.h5");
//            writer.numbers("/data/train/torque", {n}, torque, {"N m", "measured torque"});
//            writer.declare_runs("/runs/fade/population", runs, {generations + 1, members, parameters}, {...});
//            for each run, in any order: writer.write_run("/runs/fade/population", run, values);
//            std::string sha256 = writer.finish();
// Shapes     row-major; {} is one number alone
// Memory     the values of one call (in blocks: 1 MiB of them), a chunk, and 64 KiB per dataset of small runs (for each
//            block of runs that is begun and not whole: one, when runs come in order); attributes and small arrays stay
// Bytes      equal calls in equal order give equal files; equal content in any order gives an equal sha256
// Errors     Error with exit code 74 when the disk fails (in the call that meets it or a later one; then nothing is
//            published, and the only thing left to do is to destroy the writer); 73 when the name is a folder
// Threads    one at a time, and nothing else in the process may use HDF5 meanwhile

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/store/byte_ranges.hpp"
#include "engine/store/chunk_writer.hpp"
#include "engine/store/content_digest.hpp"
#include "engine/store/dimension_scales.hpp"
#include "engine/store/file_seal.hpp"
#include "engine/store/h5.hpp"
#include "engine/store/run_blocks.hpp"
#include "engine/store/temp_file.hpp"
#include "engine/store/written_result.hpp"

namespace torquescope {

inline constexpr std::int64_t result_format = 3;
inline constexpr std::int64_t first_format_of_this_digest = 2;

struct ResultWriterOptions {
  bool gzip = false;                  // level 1 without shuffle: a fifth of the size for histories, five times the time
  std::uintmax_t expected_bytes = 0;  // as far as that is known: said where there is no room
  std::string inputs_sha256{};        // of the job it belongs to: its identity in the seal (file_seal.hpp)
  Keeps keeps = Keeps::result;
};

// what a dataset says about itself
struct Note {
  std::string unit;                       // "1" for none
  std::string long_name;                  // for people: label of an axis
  std::string source{};                   // paper, section, equation; "" when there is none
  std::vector<std::string> dimensions{};  // each names its scale (dimension_scales.hpp); none: no scales

  Note over(std::vector<std::string> const& names) const { return {unit, long_name, source, names}; }
};

enum class RunValues { number, whole_number };

class ResultWriter {
 public:
  explicit ResultWriter(FilePlace const& place, ResultWriterOptions options = {});
  ~ResultWriter();  // leaves nothing behind unless finished

  void numbers(std::string const& path, h5::Shape const& shape, std::span<double const> values, Note const& note);
  void whole_numbers(std::string const& path, h5::Shape const& shape, std::span<std::int64_t const> values,
                     Note const& note);
  // the same of arrays that nobody holds whole: rows(first, values) fills values with the rows from `first` on
  template <class Value>
  using MakeRows = std::function<void(std::size_t first, std::span<Value> values)>;
  void numbers_in_blocks(std::string const& path, h5::Shape const& shape, MakeRows<double> const& rows,
                         Note const& note);
  void whole_numbers_in_blocks(std::string const& path, h5::Shape const& shape, MakeRows<std::int64_t> const& rows,
                               Note const& note);
  void texts(std::string const& path, std::span<std::string const> values, Note const& note);
  // on a dataset or a group; the group is created when there is nothing of that name. A second value replaces the first
  void attribute(std::string const& object_path, std::string const& name, OptionValue const& value);

  // [runs][shape_of_one_run...]; runs never written read as NaN (whole numbers: 0)
  void declare_runs(std::string const& path, std::size_t runs, h5::Shape const& shape_of_one_run, Note const& note,
                    RunValues values = RunValues::number);
  // owner: while it lives the values stay as they are, and none is copied to be digested later
  void write_run(std::string const& path, std::size_t run, std::span<double const> values,
                 std::shared_ptr<void const> const& owner = {});
  void write_run(std::string const& path, std::size_t run, std::span<std::int64_t const> values);

  // all lists of `count` neighbouring runs: the same bytes as from one run after the other, each list in turn
  struct RunsOfList {
    std::string path;
    h5::Element element = h5::Element::number;
    std::span<std::byte const> values{};
    std::shared_ptr<void const> owner{};
  };
  void write_runs(std::size_t first, std::size_t count, std::span<RunsOfList const> lists);

  // a browser that knows NeXus (silx, h5web) plots the group: `signal` over `axes`, one name per dimension, "." for
  // none
  void plottable(std::string const& group, std::string const& signal, std::vector<std::string> const& axes);

  // returns content_sha256; the file now stands under its final name
  std::string finish();
  // what it says, of a writer that has finished
  WrittenResult take_written() { return std::move(written_); }

 private:
  struct RunDataset {
    h5::Handle dataset;
    h5::DatasetInfo info;
    RunBlocks blocks;
  };

  h5::Handle const& group(std::string const& path);
  h5::Handle create(std::string const& path, h5::DatasetPlan const& plan, Note const& note);
  void add_attribute(h5::Handle const& object, std::string const& path, std::string const& name,
                     OptionValue const& value);
  void write_dataset(std::string const& path, h5::DatasetPlan const& plan, void const* values, Note const& note);
  template <class Value>
  void write_blocks(std::string const& path, h5::DatasetPlan plan, MakeRows<Value> const& rows, Note const& note);
  void digest_array(std::string const& path, h5::Element element, h5::Shape const& shape,
                    std::span<std::byte const> values);
  void put_run(std::string const& path, h5::Element element, std::size_t run, std::span<std::byte const> values,
               std::shared_ptr<void const> const& owner);
  void write_block(std::string const& path, RunDataset const& runs, std::size_t first, std::size_t count,
                   std::span<std::byte const> values, std::shared_ptr<void const> owner = {});
  template <class Write>
  void guarded(std::string const& path, Write&& write);

  ResultWriterOptions options_;
  ContentDigest digest_;
  DimensionScales scales_;
  WrittenResult written_;
  ChunkWriter chunks_;
  TempFile temp_;  // before the handles: it outlives them
  ByteRanges values_;
  h5::Handle file_;
  std::map<std::string, h5::Handle> groups_;  // those met so far: HDF5 walks from the root to each of them in 10 us
  std::map<std::string, RunDataset> runs_;
};

}  // namespace torquescope
