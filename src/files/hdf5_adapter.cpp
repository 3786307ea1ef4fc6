// The only file that includes HDF5.
#include "files/hdf5_adapter.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "base/error.h"
#include "files/checked_file.h"

namespace seiche {
namespace {

std::filesystem::path unfinished(const std::filesystem::path& path) {
  return path.string() + ".tmp";
}

// Closes a handle of HDF5 at the end of its scope.
class HdfHandle {
 public:
  HdfHandle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~HdfHandle() {
    if (id_ >= 0) close_(id_);
  }
  HdfHandle(const HdfHandle&) = delete;
  HdfHandle& operator=(const HdfHandle&) = delete;
  hid_t id() const { return id_; }
  bool failed() const { return id_ < 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// Chunks of at most 2^20 numbers: whole slabs of the last indices.
std::vector<hsize_t> chunk_of(std::vector<hsize_t> extents) {
  constexpr hsize_t most = hsize_t(1) << 20;
  hsize_t inner = 1;
  for (std::size_t a = extents.size(); a-- > 0;) {
    extents[a] = std::clamp<hsize_t>(most / inner, 1, extents[a]);
    inner *= extents[a];
  }
  return extents;
}

}  // namespace

Hdf5Writer::Hdf5Writer(const std::filesystem::path& path) : path_(path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // its own report of errors on the terminal
  file_ = H5Fcreate(unfinished(path).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (file_ < 0) throw Error(ExitCode::output_failed, describe_failure(path, "cannot be created", errno));
}

Hdf5Writer::~Hdf5Writer() {
  if (file_ < 0) return;
  H5Fclose(file_);
  std::error_code ignored;
  std::filesystem::remove(unfinished(path_), ignored);
}

void Hdf5Writer::write(const std::string& name, const std::vector<std::uint64_t>& extents,
                       const std::vector<float>& values) {
  write(name, extents, H5T_NATIVE_FLOAT, values.data());
}

void Hdf5Writer::write(const std::string& name, const std::vector<std::uint64_t>& extents,
                       const std::vector<std::int32_t>& values) {
  write(name, extents, H5T_NATIVE_INT32, values.data());
}

void Hdf5Writer::write(const std::string& name, const std::vector<std::uint64_t>& extents, std::int64_t type,
                       const void* values) {
  constexpr unsigned level = 4;  // of deflate
  const std::vector<hsize_t> sizes(extents.begin(), extents.end());
  const HdfHandle space(H5Screate_simple(int(sizes.size()), sizes.data(), nullptr), H5Sclose);
  const HdfHandle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose), form(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.id(), 1);
  if (std::ranges::all_of(sizes, [](hsize_t n) { return n > 0; })) {
    H5Pset_chunk(form.id(), int(sizes.size()), chunk_of(sizes).data());
    H5Pset_shuffle(form.id());
    H5Pset_deflate(form.id(), level);
  }
  const HdfHandle set(H5Dcreate2(file_, name.c_str(), type, space.id(), links.id(), form.id(), H5P_DEFAULT), H5Dclose);
  if (set.failed() || H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    throw Error(ExitCode::output_failed, describe_failure(path_, "cannot hold " + name, errno));
}

void Hdf5Writer::close() {
  const auto file = std::exchange(file_, -1);
  if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0 || H5Fclose(file) < 0) {
    std::error_code ignored;
    std::filesystem::remove(unfinished(path_), ignored);
    throw Error(ExitCode::output_failed, describe_failure(path_, "cannot be written", errno));
  }
  rename_durably(unfinished(path_), path_);
}

}  // namespace seiche
