#include "io/validate_markdown.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/version.h"

namespace seiche {
namespace {

constexpr std::size_t short_digest = 8;  // of a build's digest: enough to tell builds apart

// "; 12 of them made by other builds"
std::string words_on_builds(const Report& report) {
  const auto others = std::ranges::count_if(report.results, [](const ReportedResult& row) {
    return is_measured(row.result) && row.result.origin.build != build_digest();
  });
  return others == 0 ? "" : fmt::format("; {} of them made by other builds", others);
}

// A cell of a table.
std::string cell(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
  return safe;
}

// "3f2a81c0, 2026-11-22, 35 min": build, day, and what it took.
std::string origin_of(const CaseResult& r) {
  if (!is_measured(r)) return "-";
  std::string text = fmt::format("{}, {}", r.origin.build.substr(0, short_digest), r.origin.date);
  if (r.origin.ranks > 1) text += fmt::format(", {} ranks", r.origin.ranks);
  return text + (r.wall_seconds < 100 ? fmt::format(", {:.0f} s", r.wall_seconds)
                                      : fmt::format(", {:.0f} min", r.wall_seconds / 60));
}

std::string row_of(const ReportedResult& row) {
  const CaseResult& r = row.result;
  const bool measured = is_measured(r);
  const auto short_figure = [](const std::optional<double>& v) { return v ? fmt::format("{:.2f}", *v) : "-"; };
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", row.resolution.name,
                     measured ? figure(r.measured.value) : "-", figure(r.measured.reference),
                     measured ? figure(r.measured.error) : "-", figure(max_error_of(row.one, row.resolution)),
                     short_figure(r.order), short_figure(r.fitted_order), short_figure(row.one.min_order),
                     r.verdict == Verdict::passed ? "pass" : "**" + verdict_name(r.verdict) + "**", origin_of(r),
                     cell(measured ? row.resolution.others : r.message.substr(0, r.message.find('\n'))));
}

std::string section_of(const Report& report, const std::vector<ReportedResult>& rows) {
  const CaseSpec& one = rows[0].one;
  std::string text = fmt::format("## {}\n\n`{}`\n\n", one.title, command_of(report, one));
  text += "| run | measured | reference | error | bar | order | fit | least | | made by | others |\n";
  text += "|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const ReportedResult& row : rows) text += row_of(row);
  if (!one.others.empty()) text += fmt::format("\nOthers: {}.\n", one.others);
  if (const std::string why = words_on_misses(rows); !why.empty()) text += "\n" + why + "\n";
  return text + "\n";
}

std::string list_of_misses(const Report& report) {
  std::string text;
  for (const auto& rows : by_case(report))
    for (const ReportedResult& row : rows)
      if (row.result.verdict != Verdict::passed)
        text += fmt::format("- `{} {}`: {}{}\n", row.one.name, row.resolution.name, verdict_name(row.result.verdict),
                            is_measured(row.result)
                                ? fmt::format(", error {} where {} passes", figure(row.result.measured.error),
                                              figure(max_error_of(row.one, row.resolution)))
                                : "");
  return text.empty() ? "" : "Not passed:\n\n" + text + "\n";
}

}  // namespace

std::string command_of(const Report& report, const CaseSpec& one) {
  return fmt::format("seiche validate {} --level {}", one.name, report.level);
}

std::string figure(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "-";
}

std::string words_on_misses(const std::vector<ReportedResult>& rows) {
  const bool missed = std::any_of(rows.begin(), rows.end(), [](const ReportedResult& row) {
    return row.result.verdict == Verdict::missed || row.result.verdict == Verdict::failed;
  });
  if (!missed) return {};
  const std::string& known = rows[0].one.known;
  return known.empty() ? "Misses its bar; the cause is not known." : "Misses its bar: " + known;
}

std::string format_markdown(const Report& report) {
  std::string text = fmt::format(
      "# What was validated\n\nWritten by `seiche validate --level {} --write-docs`, version {}, build {}: {}{}. "
      "[Validating](validating.md) tells how cases are run and judged; a case's own page is "
      "`validation/<case>/README.md`. \"order\" is that from the run above, \"fit\" the least-squares order over all "
      "runs of a case, \"least\" the fit that passes, \"made by\" the build (the start of its digest), the day and the "
      "time that the run took.\n\n",
      report.level, version(), build_digest().substr(0, short_digest), table_summary(report), words_on_builds(report));
  text += list_of_misses(report);
  for (const auto& rows : by_case(report)) text += section_of(report, rows);
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace seiche
