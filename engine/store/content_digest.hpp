#pragma once
// SHA-256 of what a result file says, whatever its bytes are: the same for gzip and plain storage, any number of
// threads, any order in which runs were written.
//
// Definition RESULT_FORMAT.md, "Digest": a digest over the digests of attributes and of blocks of values, in the order
//            of their addresses in the file. A block is some rows of a dataset, so the writer can digest each while its
//            bytes are still in the processor's cache and nothing is read back.
// Covers     every object but /provenance: path, attributes (type, shape, values), of a dataset element type, shape
//            and values. Texts count without padding.
// Memory     32 bytes per block and attribute, up to 6 MiB of blocks that wait
// Threads    one at a time

#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/digest.hpp"
#include "engine/store/h5.hpp"

namespace torquescope {

// root attributes that say something about the file rather than about its content
inline constexpr char complete_key[] = "complete";
inline constexpr char sealed_key[] = "sealed";  // 1: the file ends with a seal (file_seal.hpp)
inline constexpr char content_digest_key[] = "content_sha256";
inline constexpr char provenance_digest_key[] = "provenance_sha256";  // of files that have the group
inline constexpr char provenance_path[] = "/provenance";

// rows of a dataset that are digested together: as many as fit into these bytes, at least one; texts: all of them
inline constexpr std::size_t digest_block_bytes = std::size_t{64} << 10;
std::size_t rows_of_block(h5::Element element, h5::Shape const& shape);
std::size_t blocks_of(h5::Element element, h5::Shape const& shape);
std::size_t bytes_of_row(h5::Shape const& shape);  // of numbers

// of the program that wrote the file
bool is_volatile(std::string const& path);

// what the digest covers, and what it leaves out because it differs from one run of a job to the next
enum class FilePart { content, provenance };

class ContentDigest {
 public:
  void group(std::string const& path);
  // value: as the file gives it back (h5::as_stored); a second one replaces the first
  void attribute(std::string const& path, std::string const& name, OptionValue const& value);
  void dataset(std::string const& path, h5::Element element, h5::Shape const& shape);
  bool has_dataset(std::string const& path) const;
  // row-major values of the rows of one block. While `owner` lives they stay as they are; without one they are copied,
  // if they have to wait
  void block(std::string const& path, std::size_t index, std::span<std::byte const> values,
             std::shared_ptr<void const> owner = {});
  // several blocks of block_bytes each, one after the other: none is copied, and one that repeats the one before (a
  // column of one value) is not digested again
  void blocks(std::string const& path, std::size_t first_index, std::span<std::byte const> values,
              std::size_t block_bytes);
  void texts(std::string const& path, std::span<std::string const> texts);

  std::string hex(FilePart part = FilePart::content);

 private:
  // blocks of one size, which wait for more of it: sixteen are digested in the time of four (digest_batch.hpp)
  struct Waiting {
    struct Block {
      std::string path;
      std::size_t index;
      std::byte const* values;
      std::shared_ptr<void const> owner;
    };
    std::size_t bytes = 0;   // of each
    std::size_t number = 0;  // of the last one, of all that ever waited
    std::vector<Block> blocks{};
  };

  struct Object {
    std::map<std::string, Sha256> attributes;
    std::string element;  // "" for a group
    h5::Shape shape;
    std::vector<Sha256> blocks;
  };

  Object& object(std::string const& path);  // with all the groups that lead to it

  Waiting& waiting_of_size(std::size_t bytes);
  void digest_waiting(Waiting& waiting);

  std::map<std::string, Object> objects_;
  std::array<Waiting, 3> waiting_;  // populations and fitness come in turns, and whole and last blocks of columns
  std::size_t n_waited_ = 0;
};

// Digests an array of which the values come in their order, in pieces of any size. The digest outlives it.
class ArrayDigest {
 public:
  ArrayDigest(ContentDigest& digest, std::string path, h5::Element element, h5::Shape const& shape);
  void add(std::span<std::byte const> values);
  void end();  // the last block may be short

 private:
  ContentDigest& digest_;
  std::string path_;
  std::size_t block_bytes_, index_ = 0;
  std::vector<std::byte> begun_{};  // of a block that is not whole yet
};

}  // namespace torquescope
