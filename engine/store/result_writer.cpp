#include "engine/store/result_writer.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/version.hpp"
#include "engine/store/chunking.hpp"

namespace torquescope {
namespace {

std::size_t count_of(h5::Shape const& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

// a block of small runs is one chunk: it is digested and written once
static_assert(digest_block_bytes == shared_chunk_bytes);

constexpr double absent_number = std::numeric_limits<double>::quiet_NaN();

bool has_values(h5::Shape const& shape) { return std::find(shape.begin(), shape.end(), 0U) == shape.end(); }

std::size_t bytes_per_value(h5::DatasetPlan const& plan) {
  return plan.element == h5::Element::text ? plan.text_size : sizeof(double);
}

struct GroupAndName {
  std::string group, name;
};

GroupAndName split(std::string const& path) {
  TORQUESCOPE_EXPECT(path.size() > 1 && path.front() == '/' && path.back() != '/');
  std::size_t const slash = path.rfind('/');
  return {path.substr(0, slash), path.substr(slash + 1)};
}

Error cannot_write(std::filesystem::path const& name, std::string const& object, h5::Failure const& failure) {
  Problem problem;
  problem.code = ExitCode::io;
  problem.what = "cannot write " + object + " into " + name.string() + ": " + failure.what();
  problem.help = "nothing was published; check the disk and run the same command again";
  return Error(std::move(problem));
}

}  // namespace

// HDF5 never sees a failing disk (h5_output_driver.hpp), so the disk is asked after each step
template <class Write>
void ResultWriter::guarded(std::string const& path, Write&& write) {
  TORQUESCOPE_EXPECT(file_.id() >= 0);
  temp_.check();
  try {
    write();
  } catch (h5::Failure const& failure) {
    temp_.check();
    throw cannot_write(temp_.final_name(), path, failure);
  }
  temp_.check();
}

ResultWriter::ResultWriter(FilePlace const& place, ResultWriterOptions options)
    : options_(std::move(options)),
      written_(place.path),
      chunks_(options_.gzip),
      temp_(place, options_.expected_bytes) {
  try {
    file_ = h5::create_file(temp_, values_);
  } catch (h5::Failure const& failure) {
    temp_.check();
    throw cannot_write(place.path, "/", failure);
  }
  written_.keep_object("/");
  attribute("/", "format", result_format);
  attribute("/", "creator", std::string("torquescope ") + version);
  attribute("/", sealed_key, std::int64_t{1});
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::add_attribute(h5::Handle const& object, std::string const& path, std::string const& name,
                                 OptionValue const& value) {
  h5::write_attribute(object, name, value);
  OptionValue stored = h5::as_stored(value);
  digest_.attribute(path, name, stored);
  written_.keep_attribute(path, name, std::move(stored));
}

// is made when there is none
h5::Handle const& ResultWriter::group(std::string const& path) {
  auto const known = groups_.find(path);
  if (known != groups_.end()) return known->second;
  written_.keep_object(path.empty() ? "/" : path);
  return groups_.emplace(path, h5::make_groups(file_, path)).first->second;
}

h5::Handle ResultWriter::create(std::string const& path, h5::DatasetPlan const& plan, Note const& note) {
  TORQUESCOPE_EXPECT(!note.unit.empty() && !note.long_name.empty());
  auto const [group, name] = split(path);
  h5::Handle dataset = h5::create_dataset(this->group(group), name, plan);
  digest_.dataset(path, plan.element, plan.shape);
  written_.keep_object(path, plan.shape);
  scales_.add(path, plan.shape, note.dimensions);
  add_attribute(dataset, path, "units", note.unit);
  add_attribute(dataset, path, "long_name", note.long_name);
  if (!note.source.empty()) add_attribute(dataset, path, "source", note.source);
  return dataset;
}

void ResultWriter::write_dataset(std::string const& path, h5::DatasetPlan const& plan, void const* values,
                                 Note const& note) {
  h5::DatasetPlan complete = plan;
  complete.gzip = options_.gzip;
  if (has_values(plan.shape)) complete.chunk = chunk_of_array(plan.shape, bytes_per_value(plan));
  guarded(path, [&] {
    h5::Handle const dataset = create(path, complete, note);
    h5::DatasetInfo const info{plan.element, plan.shape, complete.chunk, plan.text_size};
    if (info.chunk.empty())
      h5::write_rows(dataset, info, 0, info.rows(), values);
    else
      chunks_.write(dataset, info, 0, info.rows(), values);
  });
}

// of an array that is there as a whole
void ResultWriter::digest_array(std::string const& path, h5::Element element, h5::Shape const& shape,
                                std::span<std::byte const> values) {
  if (values.empty()) return;
  ArrayDigest digest(digest_, path, element, shape);
  digest.add(values);
  digest.end();
}

void ResultWriter::numbers(std::string const& path, h5::Shape const& shape, std::span<double const> values,
                           Note const& note) {
  TORQUESCOPE_EXPECT(values.size() == count_of(shape));
  write_dataset(path, {.element = h5::Element::number, .shape = shape, .chunk = {}}, values.data(), note);
  digest_array(path, h5::Element::number, shape, std::as_bytes(values));
  written_.keep_numbers(path, values);
}

void ResultWriter::whole_numbers(std::string const& path, h5::Shape const& shape, std::span<std::int64_t const> values,
                                 Note const& note) {
  TORQUESCOPE_EXPECT(values.size() == count_of(shape));
  write_dataset(path, {.element = h5::Element::whole_number, .shape = shape, .chunk = {}}, values.data(), note);
  digest_array(path, h5::Element::whole_number, shape, std::as_bytes(values));
}

template <class Value>
void ResultWriter::write_blocks(std::string const& path, h5::DatasetPlan plan, MakeRows<Value> const& rows,
                                Note const& note) {
  plan.gzip = options_.gzip;
  if (has_values(plan.shape)) plan.chunk = chunk_of_array(plan.shape, sizeof(Value));
  guarded(path, [&] {
    h5::Handle const dataset = create(path, plan, note);
    if (!has_values(plan.shape)) return;
    h5::DatasetInfo const info{plan.element, plan.shape, plan.chunk, plan.text_size};
    // whole chunks, each touched once; a row that is wider than a chunk is cut, so it cannot be made in its place
    std::size_t const most_rows = plan.chunk.front(), width = info.values_per_row(), values_at_once = most_rows * width;
    bool const in_place = values_at_once == count_of(plan.chunk);
    std::vector<Value> wide(in_place ? 0 : values_at_once);
    auto* const values =
        in_place ? reinterpret_cast<Value*>(chunks_.room(values_at_once * sizeof(Value)).data()) : wide.data();
    ArrayDigest digest(digest_, path, plan.element, plan.shape);
    for (std::size_t first = 0; first < info.rows(); first += most_rows) {
      std::size_t const count = std::min(most_rows, info.rows() - first);
      std::span<Value> const block(values, count * width);
      rows(first, block);
      digest.add(std::as_bytes(block));
      chunks_.write(dataset, info, first, count, values);
    }
    digest.end();
  });
}

void ResultWriter::numbers_in_blocks(std::string const& path, h5::Shape const& shape, MakeRows<double> const& rows,
                                     Note const& note) {
  write_blocks<double>(path, {.element = h5::Element::number, .shape = shape, .chunk = {}}, rows, note);
}

void ResultWriter::whole_numbers_in_blocks(std::string const& path, h5::Shape const& shape,
                                           MakeRows<std::int64_t> const& rows, Note const& note) {
  write_blocks<std::int64_t>(path, {.element = h5::Element::whole_number, .shape = shape, .chunk = {}}, rows, note);
}

void ResultWriter::texts(std::string const& path, std::span<std::string const> values, Note const& note) {
  h5::PaddedTexts const padded(values);
  write_dataset(path,
                {.element = h5::Element::text, .shape = {values.size()}, .chunk = {}, .text_size = padded.size_of_one},
                padded.bytes.data(), note);
  if (!values.empty()) digest_.texts(path, padded.texts());
  written_.keep_texts(path, padded.texts());
}

void ResultWriter::attribute(std::string const& object_path, std::string const& name, OptionValue const& value) {
  guarded(object_path, [&] {
    if (digest_.has_dataset(object_path))
      add_attribute(h5::open_object(file_, object_path), object_path, name, value);
    else
      add_attribute(group(object_path), object_path, name, value);
  });
}

void ResultWriter::declare_runs(std::string const& path, std::size_t runs, h5::Shape const& shape_of_one_run,
                                Note const& note, RunValues values) {
  TORQUESCOPE_EXPECT(!runs_.contains(path));
  h5::DatasetPlan plan{.element = values == RunValues::number ? h5::Element::number : h5::Element::whole_number,
                       .shape = {runs},
                       .chunk = {},
                       .gzip = options_.gzip};
  plan.shape.insert(plan.shape.end(), shape_of_one_run.begin(), shape_of_one_run.end());
  if (has_values(plan.shape)) plan.chunk = chunk_of_runs(plan.shape, bytes_per_value(plan));
  guarded(path, [&] {
    h5::DatasetInfo const info{plan.element, plan.shape, plan.chunk, 0};
    std::size_t const bytes_of_run = info.values_per_row() * sizeof(double);
    // blocks of the digest are chunks too, unless a run has several of those
    RunBlocks blocks(has_values(plan.shape) ? runs : 0, bytes_of_run, rows_of_block(plan.element, plan.shape),
                     values == RunValues::number ? std::bit_cast<std::uint64_t>(absent_number) : 0);
    runs_.emplace(path, RunDataset{create(path, plan, note), info, std::move(blocks)});
  });
}

void ResultWriter::write_block(std::string const& path, RunDataset const& runs, std::size_t first, std::size_t count,
                               std::span<std::byte const> values, std::shared_ptr<void const> owner) {
  digest_.block(path, first / rows_of_block(runs.info.element, runs.info.shape), values, std::move(owner));
  chunks_.write(runs.dataset, runs.info, first, count, values.data());
}

void ResultWriter::put_run(std::string const& path, h5::Element element, std::size_t run,
                           std::span<std::byte const> values, std::shared_ptr<void const> const& owner) {
  TORQUESCOPE_EXPECT(runs_.contains(path));
  RunDataset& runs = runs_.at(path);
  TORQUESCOPE_EXPECT(runs.info.element == element);
  if (!has_values(runs.info.shape)) return;
  guarded(path, [&] {
    runs.blocks.put(run, values, [&](std::size_t first, std::size_t count, std::span<std::byte const> block) {
      // a block that was put together is not the owner's
      bool const is_owned = block.data() >= values.data() && block.data() < values.data() + values.size();
      write_block(path, runs, first, count, block, is_owned ? owner : nullptr);
    });
  });
}

void ResultWriter::write_run(std::string const& path, std::size_t run, std::span<double const> values,
                             std::shared_ptr<void const> const& owner) {
  put_run(path, h5::Element::number, run, std::as_bytes(values), owner);
}

void ResultWriter::write_run(std::string const& path, std::size_t run, std::span<std::int64_t const> values) {
  put_run(path, h5::Element::whole_number, run, std::as_bytes(values), {});
}

void ResultWriter::write_runs(std::size_t first, std::size_t count, std::span<RunsOfList const> lists) {
  std::size_t const end = first + count;
  std::vector<std::size_t> begin(lists.size(), first);
  for (std::size_t run = first; run < end; ++run)
    for (std::size_t i = 0; i < lists.size(); ++i) {
      auto const& list = lists[i];
      TORQUESCOPE_EXPECT(runs_.contains(list.path));
      if (run + 1 < end && !runs_.at(list.path).blocks.ends_block(run)) continue;
      std::size_t const bytes = list.values.size() / count;
      put_run(list.path, list.element, begin[i],
              list.values.subspan((begin[i] - first) * bytes, (run + 1 - begin[i]) * bytes), list.owner);
      begin[i] = run + 1;
    }
}

void ResultWriter::plottable(std::string const& group, std::string const& signal,
                             std::vector<std::string> const& axes) {
  attribute(group, "NX_class", std::string("NXdata"));
  attribute(group, "signal", signal);
  attribute(group, "axes", axes);
}

std::string ResultWriter::finish() {
  // a reader believes no dataset that is much larger than its file, so absent runs take their space too
  for (auto& [path, runs] : runs_) {
    auto const write = [&, &path = path, &runs = runs](std::size_t first, std::size_t count,
                                                       std::span<std::byte const> block) {
      write_block(path, runs, first, count, block);
    };
    guarded(path, [&, &runs = runs] { runs.blocks.put_rest(write); });
  }
  runs_.clear();
  values_
      .close();  // HDF5 calls the lists of scales raw data, and they have no checksum of their own: the seal has them
  guarded("/", [&] { scales_.attach(file_); });
  std::string sha256 = digest_.hex();
  attribute("/", content_digest_key, sha256);
  if (h5::exists(file_, provenance_path)) attribute("/", provenance_digest_key, digest_.hex(FilePart::provenance));
  attribute("/", complete_key, std::int64_t{1});

  groups_.clear();
  bool const closed = file_.close();
  temp_.check();
  if (!closed) throw cannot_write(temp_.final_name(), "/", h5::Failure("HDF5 could not close the file"));
  seal_file(temp_, values_, job_identity(options_.inputs_sha256, options_.keeps));
  temp_.publish();
  return sha256;
}

}  // namespace torquescope
