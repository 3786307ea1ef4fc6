#pragma once
// The only interface to HDF5: writes arrays to a new file.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

// Writes to `path`.tmp; close() renames to `path`. All throw Error(output_failed) naming the path and the array.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(const std::filesystem::path& path);
  ~Hdf5Writer();  // without close(): removes the temporary file
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  // An array "/group/name", last index fastest, compressed; missing groups are created.
  void write(const std::string& name, const std::vector<std::uint64_t>& extents, const std::vector<float>& values);
  void write(const std::string& name, const std::vector<std::uint64_t>& extents,
             const std::vector<std::int32_t>& values);
  void close();

 private:
  void write(const std::string& name, const std::vector<std::uint64_t>& extents, std::int64_t type, const void* values);

  std::filesystem::path path_;
  std::int64_t file_ = -1;
};

}  // namespace seiche
