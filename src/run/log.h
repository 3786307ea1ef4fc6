#pragma once
// Messages of a run: to the terminal through the given console, and to log.txt once the run directory exists.
#include <functional>
#include <memory>
#include <string>

#include "base/communicator.h"
#include "files/checked_file.h"

namespace seiche {

enum class Verbosity { normal, quiet };

// Output for the user, supplied by tools/. Called on rank 0 only.
struct Console {
  std::function<void(const std::string&)> line;     // one finished line of ordinary output
  std::function<void(const std::string&)> warning;  // one finished line
  std::function<void(const std::string&)> live;     // replaces the live line; unset if the output is not a terminal
};

class RunLog {
 public:
  RunLog(const Communicator& ranks, Console console, Verbosity verbosity)
      : ranks_(ranks), console_(std::move(console)), verbosity_(verbosity) {}

  // From now on everything also goes to this file (rank 0 opens it); earlier messages are written first.
  void open(const std::filesystem::path& file);
  void note(const std::string& text);
  void warn(const std::string& text);
  void live(const std::string& text);
  void record(const std::string& text);  // to the file only
  void flush();                          // throws Error(output_failed) on rank 0
  bool has_live_line() const { return bool(console_.live) && verbosity_ == Verbosity::normal; }

 private:
  void keep(const std::string& line);

  const Communicator& ranks_;
  Console console_;
  Verbosity verbosity_;
  std::string before_open_;
  std::unique_ptr<AppendFile> file_;
};

}  // namespace seiche
