#include "console.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

namespace seiche {
namespace {

// True if stdout is a terminal of the user. mpirun gives each rank a pseudo-terminal, whatever its own output is; so
// under mpirun the output of the parent process decides.
bool is_terminal() {
  if (::isatty(STDOUT_FILENO) == 0) return false;
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) return true;
  std::error_code failed;
  const std::string out = std::filesystem::read_symlink(fmt::format("/proc/{}/fd/1", ::getppid()), failed).string();
  return !failed && (out.starts_with("/dev/pts/") || out.starts_with("/dev/tty"));
}

// Ends a live line before other output.
void finish_live(bool& live) {
  if (live) std::fputs("\n", stdout);
  live = false;
}

}  // namespace

void print_error(const std::string& message) {
  std::fflush(stdout);
  fmt::print(stderr, "seiche: {}\n", message);
  std::fflush(stderr);
}

Console terminal_console() {
  const auto live = std::make_shared<bool>(false);
  Console console;
  console.line = [live](const std::string& text) {
    finish_live(*live);
    std::fputs((text + "\n").c_str(), stdout);
    std::fflush(stdout);
  };
  console.warning = [live](const std::string& text) {
    finish_live(*live);
    std::fflush(stdout);
    std::fputs((text + "\n").c_str(), stderr);
  };
  if (!is_terminal()) return console;
  console.live = [live](const std::string& text) {
    *live = true;
    std::fputs(("\r\033[K" + text).c_str(), stdout);
    std::fflush(stdout);
  };
  return console;
}

}  // namespace seiche
