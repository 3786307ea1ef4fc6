#include "scene/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/suggest.h"
#include "scene/formula.h"
#include "scene/parameters.h"
#include "scene/values.h"

namespace seiche {
namespace {

constexpr std::size_t most_points = 1'000'000;

std::vector<std::string> cells_of_line(std::string line) {
  const char separator = line.find(';') != std::string::npos ? ';' : line.find('\t') != std::string::npos ? '\t' : ',';
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == separator)
      cells.emplace_back();
    else if (c != '\r' && c != ' ' && c != '"')
      cells.back() += c;
  }
  return cells;
}

bool is_number_node(const TomlNode& node) {
  return node.kind == TomlNode::Kind::number || node.kind == TomlNode::Kind::integer;
}

class CurveReader {
 public:
  CurveReader(SceneContext& context, const TomlEntry& entry)
      : context_(context), table_(entry.value), path_("curves." + entry.key), line_(entry.line) {}

  // The curve; without points where a fault was reported.
  TimeCurve read() {
    TimeCurve curve;
    if (table_.kind != TomlNode::Kind::table)
      return report("must be a table, such as { file = \"motion.csv\" } or { times = [0, 1], values = [0, 2] }"), curve;
    for (const TomlEntry& key : table_.entries) {
      const std::vector<std::string> known{"times", "values", "file", "time", "value", "scale", "interpolate"};
      if (std::ranges::find(known, key.key) != known.end()) continue;
      const auto near = suggest(key.key, known);
      return report("has no key '" + key.key + "'" + (near ? "; did you mean '" + *near + "'?" : "")), curve;
    }
    curve.form = form();
    if (table_.find("file"))
      read_file(curve);
    else
      curve.times = numbers("times"), curve.values = numbers("values");
    const double scale = number("scale", 1);
    for (double& value : curve.values) value *= scale;
    check(curve);
    return curve;
  }

 private:
  void report(const std::string& text) {
    failed_ = true;
    context_.report(path_, line_, path_ + ": " + text);
  }

  CurveForm form() {
    const TomlEntry* given = table_.find("interpolate");
    if (given && given->value.text != "smooth" && given->value.text != "linear")
      report("interpolate is \"smooth\" or \"linear\"");
    return given && given->value.text == "linear" ? CurveForm::linear : CurveForm::smooth;
  }

  double number(const std::string& key, double fallback) {
    const TomlEntry* given = table_.find(key);
    if (!given) return fallback;
    if (!is_number_node(given->value)) report(key + " must be a number");
    return given->value.number;
  }

  std::vector<double> numbers(const std::string& key) {
    const TomlEntry* given = table_.find(key);
    if (!given) return report("needs a file, or times and values"), std::vector<double>();
    std::vector<double> list;
    for (const TomlNode& item : given->value.items) {
      if (!is_number_node(item)) return report(key + " must hold numbers"), std::vector<double>();
      list.push_back(item.number);
    }
    return list;
  }

  // Index of a column that is given by its name or its number from 1; the number of cells if there is none.
  std::size_t column(const std::string& key, int fallback, const std::vector<std::string>& header) {
    const TomlEntry* given = table_.find(key);
    if (given && given->value.kind == TomlNode::Kind::text)
      return std::size_t(std::ranges::find(header, given->value.text) - header.begin());
    const double place = number(key, fallback);
    return place >= 1 && place <= double(header.size()) ? std::size_t(place) - 1 : header.size();
  }

  void read_file(TimeCurve& curve) {
    std::filesystem::path file;
    const std::string why = fault_of_path(context_, table_.find("file")->value.text, file);
    if (!why.empty()) return report(why);
    std::ifstream in(file);
    std::string row;
    std::getline(in, row);
    const std::vector<std::string> header = cells_of_line(row);
    const std::size_t t = column("time", 1, header), v = column("value", 2, header);
    if (std::max(t, v) >= header.size())
      return report(
          fmt::format("{}:1: has no such column; its columns are {}", file.string(), fmt::join(header, ", ")));
    const bool has_header = !plain_number(header[t]) || !plain_number(header[v]);
    if (!has_header) in.seekg(0);
    for (std::size_t line = has_header ? 2 : 1; std::getline(in, row); ++line) {
      if (row.find_first_not_of(" \r") == std::string::npos) continue;
      const std::vector<std::string> cells = cells_of_line(row);
      const auto time = t < cells.size() ? plain_number(cells[t]) : std::nullopt;
      const auto value = v < cells.size() ? plain_number(cells[v]) : std::nullopt;
      if (!time || !value) return report(fmt::format("{}:{}: has no numbers in these columns", file.string(), line));
      if (!curve.times.empty() && *time <= curve.times.back())
        return report(fmt::format("{}:{}: its time {:g} does not come after {:g}; sort the rows", file.string(), line,
                                  *time, curve.times.back()));
      if (curve.times.size() == most_points) return report(fmt::format("at most {} points", most_points));
      curve.times.push_back(*time);
      curve.values.push_back(*value);
    }
  }

  void check(TimeCurve& curve) {
    if (!failed_ && curve.times.size() != curve.values.size())
      report(fmt::format("has {} times and {} values", curve.times.size(), curve.values.size()));
    if (!failed_ && curve.times.empty()) report("has no points");
    for (std::size_t n = 1; !failed_ && n < curve.times.size(); ++n)
      if (!(curve.times[n] > curve.times[n - 1]))
        report(
            fmt::format("its time {:g} does not come after {:g}; sort the points", curve.times[n], curve.times[n - 1]));
  }

  SceneContext& context_;
  const TomlNode& table_;
  std::string path_;
  int line_;
  bool failed_ = false;
};

}  // namespace

std::map<std::string, TimeCurve> read_curves(SceneContext& context, const TomlNode& root) {
  declare_curves({});
  std::map<std::string, TimeCurve> curves;
  const TomlEntry* entry = root.find("curves");
  if (!entry) return curves;
  if (entry->value.kind != TomlNode::Kind::table)
    return context.report("curves", entry->line, "curves must be a table, written [curves]"), curves;
  for (const TomlEntry& one : entry->value.entries) {
    if (!is_free_name(one.key) || context.parameters.count(one.key) > 0)
      context.report("curves." + one.key, one.line,
                     "curves." + one.key + ": a curve's name is a word that formulas do not know yet");
    else
      curves[one.key] = CurveReader(context, one).read();
    if (curves.contains(one.key) && !context.clean("curves." + one.key))
      curves[one.key] = TimeCurve{{0.0}, {0.0}};  // so that formulas find it
  }
  declare_curves(curves);
  return curves;
}

}  // namespace seiche
