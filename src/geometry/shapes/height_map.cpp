#include "geometry/shapes/height_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/error.h"
#include "geometry/mesh/formats.h"

namespace seiche {
namespace {

using mesh::Source;

std::string in_lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char ch) { return char(std::tolower(ch)); });
  return text;
}

// A grid of numbers, read line by line.
class NumberGrid {
 public:
  explicit NumberGrid(const Source& source) : source_(source) {}

  HeightMap read() {
    mesh::Tokens lines(source_.bytes);
    while (!lines.at_end()) {
      const std::size_t number = lines.line();
      const std::string_view line = lines.rest_of_line();
      const std::vector<std::string_view> parts = mesh::parts_of_row(line);
      if (parts.empty() || parts[0][0] == '#') continue;
      if (map_.rows > 0 || !is_header(number, parts)) add_row(number, parts);
    }
    finish();
    return std::move(map_);
  }

 private:
  // A key of an ESRI grid with its number. Places and sizes of cells do not count: the scene gives the rectangle.
  bool is_header(std::size_t line, const std::vector<std::string_view>& parts) {
    static const std::vector<std::string> keys{"ncols",     "nrows",     "xllcorner", "yllcorner",
                                               "xllcenter", "yllcenter", "cellsize",  "nodata_value"};
    const std::string key = in_lower_case(std::string(parts[0]));
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) return false;
    const auto value = parts.size() == 2 ? mesh::to_double(parts[1]) : std::nullopt;
    if (!value) mesh::fail_at_line(source_, line, key + " must have one number");
    if (key == "ncols") columns_ = *value;
    if (key == "nrows") rows_ = *value;
    if (key == "nodata_value") missing_ = *value;
    return true;
  }

  void add_row(std::size_t line, const std::vector<std::string_view>& parts) {
    if (map_.rows > 0 && parts.size() != std::size_t(map_.columns))
      mesh::fail_at_line(source_, line,
                         fmt::format("{} numbers, but {} in the rows before", parts.size(), map_.columns));
    map_.columns = int(parts.size());
    ++map_.rows;
    if (std::int64_t(map_.columns) * map_.rows > most_map_samples)
      require_map_size(source_.file, map_.columns, map_.rows);
    for (const std::string_view part : parts) {
      const auto value = mesh::to_double(part);
      if (!value || !std::isfinite(*value))
        mesh::fail_at_line(source_, line, fmt::format("'{}' is not a number", std::string(part.substr(0, 40))));
      if (missing_ && *value == *missing_)
        mesh::fail_at_line(source_, line,
                           fmt::format("a height is missing (NODATA_value {:g}); fill the gaps", *value));
      map_.values.push_back(*value);
    }
  }

  void finish() {
    if (map_.rows == 0) throw Error(ExitCode::bad_input, source_.file.string() + ": holds no numbers");
    const auto differs = [](const std::optional<double>& said, int is) { return said && *said != is; };
    if (differs(columns_, map_.columns) || differs(rows_, map_.rows))
      throw Error(
          ExitCode::bad_input,
          fmt::format("{}: holds {} rows of {} numbers, but its header says {:g} rows of {:g}", source_.file.string(),
                      map_.rows, map_.columns, rows_.value_or(map_.rows), columns_.value_or(map_.columns)));
    if (map_.columns == 1) std::swap(map_.columns, map_.rows);  // a number a line is a row, too
    require_map_size(source_.file, map_.columns, map_.rows);
  }

  const Source& source_;
  HeightMap map_;
  std::optional<double> columns_, rows_, missing_;
};

}  // namespace

void require_map_size(const std::filesystem::path& file, std::int64_t columns, std::int64_t rows) {
  const std::string size = fmt::format("{}: a height map of {} x {} samples", file.string(), columns, rows);
  if (columns < 2) throw Error(ExitCode::bad_input, size + " is too small: it needs at least 2 along each axis");
  if (rows > most_map_samples / columns)
    throw Error(ExitCode::bad_input, fmt::format("{} is too large: at most {} in all; make it smaller (finer than half "
                                                 "a cell it is averaged anyway)",
                                                 size, most_map_samples));
}

HeightMap read_height_map(const std::filesystem::path& file) {
  if (in_lower_case(file.extension().string()) == ".png") return read_grey_png(file);
  const Source source{file, mesh::read_bytes(file)};
  return NumberGrid(source).read();
}

}  // namespace seiche
