// Rows of points: x and y of a closed polyline, an empty line between two polylines.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "geometry/mesh/formats.h"

namespace seiche::mesh {
namespace {

// Tables in UTF-8 may begin with one.
std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.substr(text.starts_with(mark) ? mark.size() : 0);
}

// Reads rows into polylines, each closed by a segment from its last point to its first.
class PointRows {
 public:
  explicit PointRows(const Source& source) : source_(source) {}

  SurfaceMesh read() {
    Tokens lines(without_byte_order_mark(source_.bytes));
    while (!lines.at_end()) {
      line_ = lines.line();
      const std::string_view row = lines.rest_of_line();
      const std::vector<std::string_view> parts = parts_of_row(row.substr(0, row.find('#')));
      if (parts.empty() && row.find('#') == std::string_view::npos) close();
      if (!parts.empty() && !is_header(parts)) add(parts);
    }
    close();
    if (mesh_.points.empty())
      throw Error(ExitCode::bad_input, source_.file.string() + ": holds no points; give x and y of one in each row");
    return std::move(mesh_);
  }

 private:
  // The first row may name the columns: no part of it begins as a number does.
  bool is_header(const std::vector<std::string_view>& parts) {
    const bool is_first = std::exchange(at_start_, false);
    return is_first && std::none_of(parts.begin(), parts.end(), [](std::string_view p) {
             return std::string_view("0123456789+-.").find(p[0]) != std::string_view::npos || to_double(p);
           });
  }

  void add(const std::vector<std::string_view>& parts) {
    if (parts.size() != 2)
      fail_at_line(source_, line_, fmt::format("{} numbers; a point of an outline has two, x and y", parts.size()));
    Vec3 p(0, 0, 0);
    for (int a = 0; a < 2; ++a) {
      const std::string_view part = parts[std::size_t(a)];
      const std::optional<double> value = to_double(part);
      if (!value || !std::isfinite(*value))
        fail_at_line(source_, line_, fmt::format("'{}' is not a number", part.substr(0, 40)));
      p[a] = *value;
    }
    if (mesh_.points.size() == max_points) fail_at_line(source_, line_, "more than 2^31-1 points");
    mesh_.points.push_back(p);
  }

  // A last point that repeats the first needs no segment.
  void close() {
    const std::size_t last = mesh_.points.size();
    if (last > first_ + 1 && mesh_.points.back() == mesh_.points[first_]) mesh_.points.pop_back();
    const std::size_t count = mesh_.points.size() - first_;
    if (count == 1 || count == 2)
      fail_at_line(source_, line_, fmt::format("an outline of {} points ends here; it takes 3 or more", count));
    for (std::size_t n = 0; n < count; ++n) mesh_.segments.push_back({int(first_ + n), int(first_ + (n + 1) % count)});
    first_ = mesh_.points.size();
  }

  const Source& source_;
  SurfaceMesh mesh_;
  std::size_t first_ = 0, line_ = 0;  // first point of the polyline that is read
  bool at_start_ = true;              // no row so far
};

}  // namespace

SurfaceMesh parse_rows_of_points(const Source& source) {
  return PointRows(source).read();
}

}  // namespace seiche::mesh
