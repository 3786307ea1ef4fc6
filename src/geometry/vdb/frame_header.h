#pragma once
// The header and the checksum of a .vdb file, checked before OpenVDB reads it.
#include <filesystem>
#include <string>

#include "base/vec.h"

namespace seiche::vdb {

// Throws Error(bad_input) if a length in the header reaches beyond the end of the file, or if the format is not the one
// that Seiche writes. OpenVDB allocates the lengths of texts, metadata and tables without such a check.
void require_sound_header(const std::filesystem::path& file, const std::string& bytes);

// Overwrites the transforms of all grids of a frame so that voxel i is at first + i h (m). The frame must have been
// written with maps of uniform scale and translation. OpenVDB cannot construct or copy a map with h^3 < 3e-15, but can
// write and read one: the translation, h, |h|, 1/h, 1/h^2 and 1/(2h), each along all axes.
std::string with_transforms(std::string bytes, const Vec3& first, double h);

// Appends a checksum of all bytes after the last grid, where readers of .vdb files ignore it. OpenVDB does not detect
// changed bytes, which may even make it write out of bounds.
std::string with_checksum(std::string bytes);

// Throws Error(bad_input) unless the file ends with the checksum of its bytes.
void require_checksum(const std::filesystem::path& file, const std::string& bytes);

// The first 200 characters of a message from another library. Unprintable characters become '?'.
std::string readable_start(const std::string& message);

}  // namespace seiche::vdb
