#include "validate/report/section.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/version.h"
#include "files/checked_file.h"
#include "validate/measure/kinds.h"
#include "validate/measure/quantity.h"
#include "validate/report/markdown.h"
#include "validate/report/readme.h"

namespace seiche {
namespace {

namespace fs = std::filesystem;
using Rows = std::vector<ReportedResult>;

fs::path whole_path(const fs::path& path) {
  return fs::absolute(path).lexically_normal();
}

// "validation/fsi3"
std::string folder_name(const CaseSpec& one) {
  return (whole_path(one.folder).parent_path().filename() / one.name).generic_string();
}

// "[scene.toml](../../validation/fsi3/scene.toml)"
std::string link_to(const CaseSpec& one, const fs::path& file) {
  const std::string below = whole_path(file).lexically_relative(whole_path(one.folder)).generic_string();
  return fmt::format("[{}]({})", file.filename().string(), link_from_page(folder_name(one), below));
}

std::string readme_of(const CaseSpec& one) {
  try {
    return embed_readme(read_whole_file(one.folder / "README.md"), folder_name(one)) + "\n";
  } catch (const Error&) {
    return {};
  }
}

// Value of a key of [measure] for the page.
std::string value_of(const CaseSpec& one, const std::string& key) {
  const MeasureSpec& m = one.measure;
  const std::pair<const char*, const std::string*> texts[] = {
      {"probe", &m.probe},         {"minus", &m.minus},    {"column", &m.column},
      {"solid", &m.solid},         {"level", &m.level},    {"reference", &m.reference},
      {"time_unit", &m.time_unit}, {"unit", &m.unit},      {"length_unit", &m.length_unit},
      {"region", &m.region},       {"surface", &m.surface}};
  for (const auto& [name, text] : texts)
    if (key == name) return "`" + *text + "`";
  if (key == "velocity") return fmt::format("`({})`", fmt::join(m.velocity, ", "));
  if (key == "data") return link_to(one, m.data);
  return fmt::format("{:g}", key == "from" ? m.from : m.to);
}

bool share_reference(const Rows& rows) {
  return std::ranges::all_of(rows, [&](const ReportedResult& row) {
    return reference_of(row.one, row.resolution) == rows[0].one.measure.reference;
  });
}

std::string words_on_measure(const Rows& rows) {
  const CaseSpec& one = rows[0].one;
  std::string text = fmt::format("Measured: {} (`{}`", what_is_measured(one.measure), one.measure.kind);
  for (const char* key : kind_of(one.measure).keys)
    if (key != std::string("reference") || share_reference(rows))
      text += fmt::format(", {} {}", key, value_of(one, key));
  const std::string& unit = rows[0].unit;
  return text + fmt::format("){}. Error: {}.", unit.empty() ? "" : ", in " + unit, error_in_words(one.measure));
}

std::string words_on_scenes(const Rows& rows) {
  const CaseSpec& one = rows[0].one;
  std::vector<std::string> links{link_to(one, one.folder / "case.toml")};
  for (const ReportedResult& row : rows) {
    const std::string link = link_to(one, scene_of(one, row.resolution));
    if (std::ranges::count(links, link) == 0) links.push_back(link);
  }
  return fmt::format("Files: {}.", fmt::join(links, ", "));
}

std::string cell_of(const std::optional<double>& v) {
  return v ? fmt::format("{:.2f}", *v) : "-";
}

std::string time_of(const CaseResult& r) {
  if (!is_measured(r)) return "-";
  return r.wall_seconds < 100 ? fmt::format("{:.0f} s", r.wall_seconds)
                              : fmt::format("{:.0f} min", r.wall_seconds / 60);
}

std::string markdown_table(const Rows& rows) {
  std::string text = "| run | cell size, m | measured | reference | error | bar | order | fit | | time |\n";
  text += "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const ReportedResult& row : rows) {
    const CaseResult& r = row.result;
    const bool measured = is_measured(r);
    text += fmt::format("| {} | {:.4g} | {} | {} | {} | {} | {} | {} | {} | {} |\n", row.resolution.name, r.cell_size,
                        measured ? whole_figure(r.measured.value) : "-", whole_figure(r.measured.reference),
                        measured ? figure(r.measured.error) : "-", figure(max_error_of(row.one, row.resolution)),
                        cell_of(r.order), cell_of(r.fitted_order),
                        r.verdict == Verdict::passed ? "pass" : "**" + verdict_name(r.verdict) + "**", time_of(r));
  }
  return text;
}

// Settings of a run: `domain.cell_size=0.01`, plus scene and reference if the runs have several.
std::string settings_of(const ReportedResult& row, bool several_scenes, bool several_references) {
  std::vector<std::string> parts;
  if (several_scenes) parts.push_back(link_to(row.one, scene_of(row.one, row.resolution)));
  for (const Override& one : row.resolution.overrides) parts.push_back(fmt::format("`{}={}`", one.path, one.value));
  const std::string scene = parts.empty() ? "the scene as it is" : fmt::format("{}", fmt::join(parts, ", "));
  return several_references ? scene + fmt::format("; reference `{}`", reference_of(row.one, row.resolution)) : scene;
}

std::string list_of_settings(const Rows& rows) {
  const bool several = std::ranges::any_of(rows, [&](const ReportedResult& row) {
    return scene_of(row.one, row.resolution) != scene_of(rows[0].one, rows[0].resolution);
  });
  std::string text = "- Runs:\n";
  for (const ReportedResult& row : rows)
    text += fmt::format("  - {}: {}\n", row.resolution.name, settings_of(row, several, !share_reference(rows)));
  return text;
}

// "by this build, 2026-11-22, 1 thread, machine 1"
std::string words_on_origin(const PageContext& page, const Origin& o) {
  std::string text = o.build == build_digest() ? "by this build" : "by build " + o.build.substr(0, short_digest);
  text += ", " + o.date;
  if (o.ranks > 1) text += fmt::format(", {} ranks", o.ranks);
  if (o.threads > 0)
    text += fmt::format(", {} thread{}{}", o.threads, o.threads == 1 ? "" : "s", o.ranks > 1 ? " each" : "");
  const auto machine = std::ranges::find(page.machines, o.machine);
  if (machine == page.machines.end()) return text;
  return text + fmt::format(", machine {}", machine - page.machines.begin() + 1);
}

std::string list_of_origins(const PageContext& page, const Rows& rows) {
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  for (const ReportedResult& row : rows) {
    if (row.result.verdict == Verdict::absent) continue;
    const std::string words = words_on_origin(page, row.result.origin);
    auto group = std::ranges::find(groups, words, [](const auto& one) { return one.first; });
    if (group == groups.end()) group = groups.insert(groups.end(), {words, {}});
    group->second.push_back(row.resolution.name);
  }
  std::string text;
  for (const auto& [words, names] : groups)
    text += fmt::format("{}{}{}", text.empty() ? "- Made " : "; ", words,
                        groups.size() > 1 ? fmt::format(": {}", fmt::join(names, ", ")) : "");
  return text.empty() ? "" : text + ".\n";
}

std::string list_of_others(const Rows& rows) {
  std::string text;
  for (const ReportedResult& row : rows)
    if (!row.resolution.others.empty())
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", row.resolution.name, row.resolution.others);
  const std::string& of_case = rows[0].one.others;
  if (!of_case.empty()) text = of_case + (text.empty() ? "" : "; " + text);
  return text.empty() ? "" : "- Others: " + text + ".\n";
}

std::string list_of_failures(const Rows& rows) {
  std::string text;
  for (const ReportedResult& row : rows)
    if (row.result.verdict == Verdict::failed)
      text += fmt::format("- {} failed: {}\n", row.resolution.name,
                          row.result.message.substr(0, row.result.message.find('\n')));
  return text;
}

}  // namespace

std::string markdown_section(const PageContext& page, const Rows& rows) {
  const CaseSpec& one = rows[0].one;
  std::string text = fmt::format("# {}: {}\n\n", one.name, one.title);
  text += readme_of(one);
  text +=
      fmt::format("{} {}\n\n    {}\n\n", words_on_measure(rows), words_on_scenes(rows), command_of(page.report, one));
  text += markdown_table(rows) + "\n" + list_of_settings(rows);
  if (one.min_order) text += fmt::format("- Least order of the fit: {:g}.\n", *one.min_order);
  text += list_of_origins(page, rows) + list_of_others(rows) + list_of_failures(rows);
  if (const std::string why = words_on_misses(rows); !why.empty())
    text += "- " + why + (why.ends_with('.') ? "\n" : ".\n");
  return text;
}

}  // namespace seiche
