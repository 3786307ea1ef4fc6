#include "charts/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include "base/error.h"

namespace seiche::charts {
namespace {

constexpr std::size_t most_columns = 1000;

[[noreturn]] void refuse_table(const std::filesystem::path& file, std::size_t line, const std::string& why) {
  throw Error(ExitCode::bad_input, fmt::format("{}:{}: {}", file.string(), line, why));
}

// Cells of a line; those in quotes may hold commas and doubled quotes (RFC 4180).
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      cells.back() += line[i++];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  }
  return cells;
}

double number_of(const std::string& cell, bool& valid) {
  double value = 0;
  const auto [end, failed] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  valid = failed == std::errc() && end == cell.data() + cell.size();
  return valid ? value : std::numeric_limits<double>::quiet_NaN();
}

// Appends the cells of one row. `name`: place of the column of names.
void add_row(Table& table, const std::vector<std::string>& cells, std::size_t name, const std::filesystem::path& file,
             std::size_t line) {
  std::size_t column = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (c == name) {
      table.names.push_back(cells[c]);
      continue;
    }
    bool valid = false;
    table.values[column].push_back(number_of(cells[c], valid));
    if (!valid && !cells[c].empty())
      refuse_table(file, line, fmt::format("'{}' in column {} is not a number", cells[c], table.columns[column]));
    ++column;
  }
}

}  // namespace

std::size_t Table::find(const std::string& column) const {
  return std::size_t(std::find(columns.begin(), columns.end(), column) - columns.begin());
}

std::vector<std::string> Table::entities() const {
  if (names.empty()) return {""};
  std::vector<std::string> different;
  for (const std::string& name : names)
    if (std::find(different.begin(), different.end(), name) == different.end()) different.push_back(name);
  return different;
}

Table read_table(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string row;
  if (!std::getline(in, row)) {
    throw Error(ExitCode::bad_input,
                fmt::format("{}: there is no such table, or it is empty; give the directory of a run", file.string()));
  }
  const std::vector<std::string> header = cells_of(row);
  if (header.size() > most_columns) refuse_table(file, 1, fmt::format("has over {} columns", most_columns));
  Table table;
  std::size_t name = header.size();
  for (std::size_t c = 0; c < header.size(); ++c) {
    if (header[c] == "name" && name == header.size())
      name = c;
    else
      table.columns.push_back(header[c]);
  }
  if (table.find("time") == table.columns.size())
    refuse_table(file, 1, "has no column 'time'; is it a table of a run?");
  table.values.resize(table.columns.size());
  for (std::size_t line = 2; std::getline(in, row) && !in.eof(); ++line) {
    const std::vector<std::string> cells = cells_of(row);
    if (cells.size() != header.size())
      refuse_table(file, line, fmt::format("has {} cells, and the header {}", cells.size(), header.size()));
    add_row(table, cells, name, file, line);
  }
  return table;
}

}  // namespace seiche::charts
