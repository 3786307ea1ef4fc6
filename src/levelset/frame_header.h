#pragma once
// The head and the checksum of a .vdb file, looked at before OpenVDB reads it.
#include <filesystem>
#include <string>

namespace seiche::vdb {

// OpenVDB believes the lengths that a file gives for its texts, metadata and tables, and allocates them. Throws
// Error(bad_input) where one reaches beyond the end of the file or the file is not in the format that Seiche writes.
void require_sound_header(const std::filesystem::path& file, const std::string& bytes);

// Frames end with a checksum of all before it, behind the last grid, where readers of .vdb files do not look: OpenVDB
// does not notice changed bytes, and may write where it must not because of them.
std::string with_checksum(std::string bytes);

// Throws Error(bad_input) where the checksum at the end does not fit. Frames of older versions have none.
void require_checksum(const std::filesystem::path& file, const std::string& bytes);

// The start of a message of another program, without what is no text.
std::string readable_start(const std::string& message);

}  // namespace seiche::vdb
