#include "render/extras.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "files/checked_file.h"
#include "render/painter.h"

extern char** environ;

namespace seiche::render {
namespace {

constexpr int gap = 6;  // pixels between the tiles of a sheet

[[noreturn]] void fail(const std::filesystem::path& film, const std::string& why) {
  throw Error(ExitCode::output_failed, fmt::format("{}: the film was not made: {}", film.string(), why));
}

// Ignores SIGPIPE during its life: writing to a closed pipe then returns an error instead of ending the program.
class IgnoredPipeSignal {
 public:
  IgnoredPipeSignal() { before_ = signal(SIGPIPE, SIG_IGN); }
  ~IgnoredPipeSignal() { signal(SIGPIPE, before_); }
  IgnoredPipeSignal(const IgnoredPipeSignal&) = delete;
  IgnoredPipeSignal& operator=(const IgnoredPipeSignal&) = delete;

 private:
  void (*before_)(int);
};

bool write_all(int handle, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(handle, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) done += std::size_t(n);
  }
  return true;
}

// Starts the program with `input` as its standard input; returns 0 or the error number.
int start(std::vector<std::string> words, int input, int to_close, pid_t& child) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_addclose(&actions, to_close);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  const int failed = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failed;
}

float label_size(int tile_width) {
  return std::max(9.0f, float(tile_width) / 26);
}

// Copies a picture into a larger one.
void paste(Image& onto, const Image& picture, int x0, int y0) {
  for (int y = 0; y < picture.height; ++y) {
    std::memcpy(&onto.rgb[3 * (std::size_t(y0 + y) * onto.width + x0)],
                &picture.rgb[3 * std::size_t(y) * picture.width], 3 * std::size_t(picture.width));
  }
}

}  // namespace

ContactSheet::ContactSheet(int pictures, int width, int height, const std::string& font)
    : font_(font), pictures_(pictures), tiles_(std::min(pictures, 12)) {
  columns_ = tiles_ > 6 ? 4 : std::min(tiles_, 3);
  tile_width_ = std::min(width, 480);
  tile_height_ = std::max(1, tile_width_ * height / width);
  label_height_ = int(1.6f * label_size(tile_width_));
  const int rows = (tiles_ + columns_ - 1) / columns_;
  image_ = {columns_ * (tile_width_ + gap) + gap, rows * (label_height_ + tile_height_ + gap) + gap, {}};
  image_.rgb.assign(std::size_t(image_.width) * image_.height * 3, 255);
}

void ContactSheet::offer(int index, const Image& picture, const std::string& label) {
  const int wanted = tiles_ > 1 ? int((long(next_) * (pictures_ - 1) + (tiles_ - 1) / 2) / (tiles_ - 1)) : 0;
  if (next_ >= tiles_ || index != wanted) return;
  const int x0 = gap + next_ % columns_ * (tile_width_ + gap);
  const int y0 = gap + next_ / columns_ * (label_height_ + tile_height_ + gap);
  paste(image_, shrink(picture, tile_width_, tile_height_), x0, y0 + label_height_);
  const float size = label_size(tile_width_);
  Painter tag(tile_width_, label_height_, Format::png, font_);
  tag.text(0.5f * size, 0.8f * size + 0.5f * cap_height(size), label, size, {0.05f, 0.06f, 0.08f});
  paste(image_, tag.image(), x0, y0);
  ++next_;
}

std::string encode_animation(const std::vector<std::filesystem::path>& pictures, double rate,
                             const std::filesystem::path& film) {
  std::filesystem::path target = std::filesystem::absolute(film);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail(film, std::strerror(errno));
  pid_t child = 0;
  const int failed =
      start({"ffmpeg", "-y", "-loglevel", "error", "-f", "image2pipe", "-framerate", fmt::format("{}", rate), "-c:v",
             "png", "-i", "-", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", target.string()},
            ends[0], ends[1], child);
  close(ends[0]);
  if (failed != 0) close(ends[1]);
  if (failed == ENOENT) return fmt::format("{} was not made: there is no ffmpeg on the PATH", film.string());
  if (failed != 0) fail(film, std::strerror(failed));
  const IgnoredPipeSignal guard;
  for (const auto& picture : pictures) {
    if (!write_all(ends[1], read_whole_file(picture))) break;  // ffmpeg has ended; its status gives the reason
  }
  close(ends[1]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail(film, "ffmpeg failed; its message stands above");
  return "";
}

}  // namespace seiche::render
