#pragma once
// The head and the checksum of a .vdb file, looked at before OpenVDB reads it.
#include <filesystem>
#include <string>

#include "base/vec.h"

namespace seiche::vdb {

// OpenVDB believes the lengths that a file gives for its texts, metadata and tables, and allocates them. Throws
// Error(bad_input) where one reaches beyond the end of the file or the file is not in the format that Seiche writes.
void require_sound_header(const std::filesystem::path& file, const std::string& bytes);

// Gives all grids of a frame, written with a map that scales alike and translates, the one that brings voxel i to
// first + i h (m). OpenVDB constructs and copies no map whose h^3 is below 3e-15, but writes and reads one: the
// translation, h, |h|, 1/h, 1/h^2 and 1/(2h), each along all axes.
std::string with_transforms(std::string bytes, const Vec3& first, double h);

// Frames end with a checksum of all before it, behind the last grid, where readers of .vdb files do not look: OpenVDB
// does not notice changed bytes, and may write where it must not because of them.
std::string with_checksum(std::string bytes);

// Throws Error(bad_input) where the checksum at the end does not fit. Frames of older versions have none.
void require_checksum(const std::filesystem::path& file, const std::string& bytes);

// The start of a message of another program, without what is no text.
std::string readable_start(const std::string& message);

}  // namespace seiche::vdb
