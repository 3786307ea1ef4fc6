#include "run/log.h"

namespace seiche {

void RunLog::open(const std::filesystem::path& file) {
  if (!ranks_.is_root()) return;
  file_ = std::make_unique<AppendFile>(file, UINT64_MAX);
  file_->append(before_open_);
  before_open_.clear();
  file_->flush();
}

void RunLog::note(const std::string& text) {
  if (!ranks_.is_root()) return;
  keep(text + "\n");
  if (verbosity_ == Verbosity::normal) console_.line(text);
}

void RunLog::warn(const std::string& text) {
  if (!ranks_.is_root()) return;
  keep("warning: " + text + "\n");
  console_.warning("warning: " + text);
}

void RunLog::live(const std::string& text) {
  if (ranks_.is_root() && has_live_line()) console_.live(text);
}

void RunLog::record(const std::string& text) {
  if (ranks_.is_root()) keep(text + "\n");
}

void RunLog::flush() {
  if (file_) file_->flush();
}

void RunLog::keep(const std::string& line) {
  if (file_) {
    file_->append(line);
  } else {
    before_open_ += line;
  }
}

}  // namespace seiche
