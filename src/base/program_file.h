#pragma once
// Places of the program and of what came with it.
#include <filesystem>
#include <string>

namespace seiche {

// The running program's file; empty if the system does not tell.
std::filesystem::path program_file();

// The folder NAME that came with the program: share/seiche/NAME beside the program's folder, or NAME two folders above
// it, as in a build tree. Empty if there is none.
std::filesystem::path installed_folder(const std::string& name);

}  // namespace seiche
