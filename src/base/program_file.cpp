#include "base/program_file.h"

#include <system_error>

namespace seiche {

namespace fs = std::filesystem;

fs::path program_file() {
  std::error_code failed;
  return fs::read_symlink("/proc/self/exe", failed);
}

fs::path installed_folder(const std::string& name) {
  const fs::path beside = program_file().parent_path();
  std::error_code failed;
  for (const fs::path& place : {beside / "../share/seiche" / name, beside / "../.." / name})
    if (fs::is_directory(place, failed)) return place.lexically_normal();
  return {};
}

}  // namespace seiche
