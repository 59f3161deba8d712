#include "engine/store/file_digest.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

namespace torquescope {
namespace {

// whole chunks, so that each is read once
std::size_t rows_at_once(h5::DatasetInfo const& info) {
  constexpr std::size_t bytes_at_once = std::size_t{1} << 20;
  std::size_t const rows = std::max<std::size_t>(1, bytes_at_once / bytes_of_row(info.shape));
  std::size_t const chunk_rows = info.chunk.empty() ? 1 : info.chunk.front();
  return rows < chunk_rows ? rows : rows / chunk_rows * chunk_rows;
}

// reads a part of a file, object by object
class FileWalk {
 public:
  FileWalk(h5::Handle const& file, FilePart part) : file_(file), part_(part) {}

  ReadFacts read() {
    if (part_ == FilePart::content) add_object("/");
    if (part_ == FilePart::provenance && h5::exists(file_, provenance_path)) add_object(provenance_path);
    facts_.sha256 = digest_.hex(part_);
    return std::move(facts_);
  }

 private:
  void add_object(std::string const& path) {
    if (is_volatile(path) != (part_ == FilePart::provenance)) return;
    std::vector<std::string> children;
    // each step is made again for every object below it
    constexpr std::ptrdiff_t most_steps = 32;
    if (std::count(path.begin(), path.end(), '/') > most_steps)
      throw h5::Failure("it lies deeper than anything in a result", path.substr(0, 100) + "...");
    try {
      h5::Handle const object = h5::open_object(file_, path);
      // groups within themselves have no end, and pairs of names double with each level
      if (!seen_.insert(h5::address(object)).second) throw h5::Failure("it has two names; results never have that");
      add_attributes(object, path);
      if (h5::is_group(object)) {
        ++facts_.groups;
        digest_.group(path);
        children = h5::child_names(object);
      } else {
        ++facts_.datasets;
        add_dataset(object, path);
      }
    } catch (h5::Failure const& failure) {
      throw h5::Failure(failure.what(), path, failure.error_number());
    }
    for (auto const& child : children) add_object((path == "/" ? path : path + "/") + child);
  }

  void add_attributes(h5::Handle const& object, std::string const& path) {
    for (auto const& name : h5::attribute_names(object)) {
      if (auto const value = h5::read_attribute(object, name)) digest_.attribute(path, name, *value);
      ++facts_.attributes;
    }
  }

  void add_dataset(h5::Handle const& dataset, std::string const& path) {
    h5::DatasetInfo const info = h5::describe(dataset);
    digest_.dataset(path, info.element, info.shape);
    if (blocks_of(info.element, info.shape) == 0) return;
    bool const is_text = info.element == h5::Element::text;
    facts_.value_bytes += static_cast<double>(info.rows()) * static_cast<double>(info.values_per_row()) *
                          static_cast<double>(is_text ? info.text_size : sizeof(double));
    // each dataset alone may be bearable, and thousands of them take hours
    h5::check_claimed_size(dataset, facts_.value_bytes);
    if (is_text)
      digest_.texts(path, h5::read_texts(dataset, info, 0, info.rows()));
    else
      add_numbers(dataset, info, path);
  }

  void add_numbers(h5::Handle const& dataset, h5::DatasetInfo const& info, std::string const& path) {
    std::size_t const step = rows_at_once(info);
    double* const values = room(std::min(step, info.rows()) * info.values_per_row());  // int64 are as large
    ArrayDigest digest(digest_, path, info.element, info.shape);
    for (std::size_t first = 0; first < info.rows(); first += step) {
      std::size_t const count = std::min(step, info.rows() - first);
      h5::read_rows(dataset, info, first, count, values, h5::spare_for_checksum);
      digest.add(std::as_bytes(std::span(values, count * info.values_per_row())));
    }
    digest.end();
  }

  // for so many values and a spare one; the same again, for new memory costs its first write as much as the digest
  double* room(std::size_t values) {
    if (values > room_values_ || !room_) {
      room_ = std::make_unique_for_overwrite<double[]>(values + 1);
      room_values_ = values;
    }
    return room_.get();
  }

  h5::Handle const& file_;
  FilePart part_;
  ContentDigest digest_{};
  ReadFacts facts_{};
  std::set<std::uint64_t> seen_{};  // addresses
  std::unique_ptr<double[]> room_{};
  std::size_t room_values_ = 0;
};

}  // namespace

ReadFacts read_everything(h5::Handle const& file, FilePart part) { return FileWalk(file, part).read(); }

}  // namespace torquescope
