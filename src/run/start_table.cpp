#include "run/start_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace seiche {
namespace {

constexpr std::size_t most_rows = 40;
constexpr std::size_t columns = 8;
using Row = std::array<std::string, columns>;

std::string numbers(const Vec3& v, int dimension, const char* between) {
  std::string text;
  for (int a = 0; a < dimension; ++a) text += fmt::format("{}{:.4g}", a > 0 ? between : "", v[a]);
  return text;
}

std::string remarks(const SolidAtStart& solid) {
  std::string text;
  if (solid.floating) text = solid.floating->sinks ? "sinks" : fmt::format("floats, {:.3g} m", solid.floating->draught);
  if (solid.outside > 0)
    text += fmt::format("{}{:.3g} % lies outside of the domain", text.empty() ? "" : "; ", 100 * solid.outside);
  return text;
}

Row row_of(const SolidAtStart& solid, int dimension) {
  const std::string name = "'" + solid.name + "'";
  if (solid.extent != SolidAtStart::Extent::body)
    return {name, solid.kind, "", "",
            "",   "",         "", solid.extent == SolidAtStart::Extent::hole ? "all but a hole" : "a half-space"};
  const bool free = solid.mass > 0;
  return {name,
          solid.kind,
          free ? fmt::format("{:.5g}", solid.mass) : "",
          free ? fmt::format("{:.4g}", solid.density()) : "",
          fmt::format("{:.5g}", solid.volume),
          "(" + numbers(solid.center, dimension, ", ") + ")",
          numbers(solid.upper - solid.lower, dimension, " x "),
          remarks(solid)};
}

Row heading(int dimension) {
  const bool flat = dimension == 2;
  return {"solid",  "kind", flat ? "kg/m" : "kg", "kg/m^3", flat ? "m^2" : "m^3", "centre, m", "size along axes, m",
          "draught"};
}

std::vector<std::string> aligned(const std::vector<Row>& rows) {
  std::array<std::size_t, columns> widths{};
  for (const Row& row : rows)
    for (std::size_t c = 0; c < columns; ++c) widths[c] = std::max(widths[c], row[c].size());
  std::vector<std::string> lines;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < columns; ++c) {
      const bool number = c >= 2 && c <= 4;
      line += number ? fmt::format("{:>{}}", row[c], widths[c]) : fmt::format("{:<{}}", row[c], widths[c]);
      if (c + 1 < columns) line += "  ";
    }
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string liquid_line(const LiquidAtStart& liquid, int dimension) {
  std::string line = fmt::format("liquid  {:.5g} m^{}, {:.5g} kg{}", liquid.volume, dimension, liquid.mass,
                                 dimension == 2 ? "/m" : "");
  if (liquid.in_solids > 0)
    line += fmt::format("; {:.5g} m^{} of its regions lies inside solids", liquid.in_solids, dimension);
  return line;
}

JsonItems items(const Vec3& v, int dimension) {
  JsonItems list;
  for (int a = 0; a < dimension; ++a) list.emplace_back(v[a]);
  return list;
}

JsonMembers solid_json(const SolidAtStart& solid, int dimension) {
  JsonMembers members{{"name", solid.name}, {"kind", solid.kind}};
  if (solid.extent != SolidAtStart::Extent::body) return members;
  members.insert(members.end(), {{"volume", solid.volume},
                                 {"center", items(solid.center, dimension)},
                                 {"lower", items(solid.lower, dimension)},
                                 {"upper", items(solid.upper, dimension)},
                                 {"share_outside", solid.outside}});
  if (solid.mass > 0) members.insert(members.end(), {{"mass", solid.mass}, {"density", solid.density()}});
  if (!solid.floating) return members;
  members.emplace_back("sinks", solid.floating->sinks);
  if (!solid.floating->sinks) members.emplace_back("draught", solid.floating->draught);
  return members;
}

}  // namespace

std::vector<std::string> start_table(const StartAccount& start, int dimension) {
  std::vector<std::string> lines{liquid_line(start.liquid, dimension)};
  for (const std::string& loss : start.losses) lines.push_back("        " + loss);
  const std::size_t count = start.solids.size(), shown = std::min(count, most_rows);
  if (count > 0) {
    std::vector<Row> rows{heading(dimension)};
    for (std::size_t k = 0; k < shown; ++k) rows.push_back(row_of(start.solids[k], dimension));
    for (std::string& line : aligned(rows)) lines.push_back(std::move(line));
  }
  if (count > shown) lines.push_back(fmt::format("and {} more solids", count - shown));
  return lines;
}

JsonMembers start_json(const StartAccount& start, int dimension) {
  JsonItems solids, notes;
  for (const SolidAtStart& solid : start.solids) solids.emplace_back(solid_json(solid, dimension));
  for (const std::vector<std::string>* lines : {&start.losses, &start.others})
    for (const std::string& line : *lines) notes.emplace_back(line);
  return {{"liquid", JsonMembers{{"volume", start.liquid.volume},
                                 {"mass", start.liquid.mass},
                                 {"volume_in_solids", start.liquid.in_solids}}},
          {"solids", solids},
          {"notes", notes}};
}

}  // namespace seiche
