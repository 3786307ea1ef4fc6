// Parses the options of `seiche render`.
#include <fmt/format.h>

#include <charconv>
#include <set>

#include "base/error.h"
#include "render/run.h"

namespace seiche::render {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else if (c != ' ')
      parts.back() += c;
  }
  return parts;
}

template <class Number>
std::optional<Number> read_number(const std::string& text) {
  Number value{};
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Describes ascending numbers, like "0-24, 30".
std::string describe(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (text.size() > 60) return text + ", ...";
    text += (text.empty() ? "" : ", ") + fmt::format("{}", numbers[i]);
    if (last > i) text += fmt::format("-{}", numbers[last]);
    i = last;
  }
  return text;
}

// Parses a range, both ends included.
std::optional<std::array<int, 2>> read_range(const std::string& part) {
  const auto ends = split(part, '-');
  if (ends.size() > 2) return std::nullopt;
  const auto first = read_number<int>(ends.front()), last = read_number<int>(ends.back());
  if (!first || !last || *first > *last) return std::nullopt;
  return std::array<int, 2>{*first, *last};
}

}  // namespace

std::array<int, 2> parse_size(const std::string& text) {
  const auto parts = split(text, 'x');
  const auto width = read_number<int>(parts.front()), height = read_number<int>(parts.back());
  const bool fits =
      parts.size() == 2 && width && height && *width >= 160 && *height >= 120 && *width <= 8192 && *height <= 8192;
  if (fits) return {*width, *height};
  throw Error(ExitCode::bad_input,
              fmt::format("--size: '{}' is not a size; give one as 1280x720, from 160x120 to 8192x8192", text));
}

CameraSpec parse_camera(const std::string& text) {
  std::vector<float> numbers;
  for (const std::string& part : split(text, ',')) {
    const auto number = read_number<float>(part);
    if (number && std::isfinite(*number))
      numbers.push_back(*number);
    else
      numbers.resize(100);  // invalid: no camera has that many
  }
  if (numbers.size() != 6 && numbers.size() != 7) {
    throw Error(ExitCode::bad_input,
                fmt::format("--camera: '{}' is not a camera; give eye_x,eye_y,eye_z,look_x,look_y,look_z "
                            "in m and, if wanted, the vertical field of view in degrees",
                            text));
  }
  CameraSpec camera{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  if (numbers.size() == 7) camera.degrees = numbers[6];
  return camera;
}

std::array<float, 2> parse_color_range(const std::string& text) {
  const auto parts = split(text, ',');
  const auto low = read_number<float>(parts.front()), high = read_number<float>(parts.back());
  if (parts.size() == 2 && low && high && std::isfinite(*low) && std::isfinite(*high) && *low < *high)
    return {*low, *high};
  throw Error(ExitCode::bad_input,
              fmt::format("--range: '{}' is not a range; give the lowest and the highest value, as 0,2.5", text));
}

std::vector<int> choose_frames(const std::string& text, const std::vector<int>& available) {
  if (text == "all") return available;
  const std::set<int> there(available.begin(), available.end());
  std::set<int> chosen;
  for (const std::string& part : split(text, ',')) {
    const auto range = read_range(part);
    if (!range) {
      throw Error(ExitCode::bad_input,
                  fmt::format("--frames: '{}' is not a list of frames; give all, 0-24, or 0,10,20", text));
    }
    for (const int end : *range) {
      if (there.count(end) > 0) continue;
      throw Error(ExitCode::bad_input,
                  fmt::format("--frames: there is no frame {}; the run has {}", end, describe(available)));
    }
    chosen.insert(there.lower_bound((*range)[0]), there.upper_bound((*range)[1]));
  }
  return {chosen.begin(), chosen.end()};
}

}  // namespace seiche::render
