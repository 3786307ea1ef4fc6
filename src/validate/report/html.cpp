#include "validate/report/html.h"

#include <fmt/format.h>

#include "base/base64.h"
#include "base/error.h"
#include "base/version.h"
#include "files/checked_file.h"
#include "validate/report/charts.h"
#include "validate/report/markdown.h"

namespace seiche {
namespace {

constexpr const char* head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Seiche: validation</title>
<style>
body { font: 15px/1.45 system-ui, sans-serif; max-width: 66rem; margin: 2rem auto; padding: 0 1rem; color: #1b1f24; }
table { border-collapse: collapse; margin: .6rem 0; }
td, th { padding: .15rem .6rem; border-bottom: 1px solid #ddd; text-align: right; }
td:first-child, th:first-child, td:last-child, th:last-child { text-align: left; }
.pass { color: #1d7a3a; } .miss { color: #b3261e; font-weight: 700; }
.row { display: flex; flex-wrap: wrap; gap: 1rem; align-items: flex-start; }
.row > * { flex: 1 1 24rem; max-width: 32rem; }
svg { width: 100%; font: 12px system-ui, sans-serif; fill: #333; }
img { width: 100%; border: 1px solid #ddd; }
pre { white-space: pre-wrap; font: inherit; background: #f6f7f9; padding: .6rem .8rem; }
h2 { margin-top: 2.6rem; border-top: 2px solid #1f5fa8; padding-top: .5rem; }
</style></head><body>
)";

std::string verdict_cell(const CaseResult& r) {
  return fmt::format("<td class='{}'>{}</td>", r.verdict == Verdict::passed ? "pass" : "miss", verdict_name(r.verdict));
}

std::string html_table(const std::vector<ReportedResult>& rows) {
  const std::string& unit = rows[0].unit;
  std::string text = "<table><tr><th>run</th><th>cell size, m</th><th>measured" +
                     escape_html(unit.empty() ? "" : ", " + unit) +
                     "</th><th>reference</th><th>error</th><th>bar</th>"
                     "<th>order</th><th>fit</th><th>least</th><th></th><th>seconds</th><th>others report</th></tr>\n";
  const auto order = [](const std::optional<double>& v) { return v ? fmt::format("{:.2f}", *v) : "-"; };
  for (const ReportedResult& row : rows) {
    const CaseResult& r = row.result;
    const bool measured = is_measured(r);
    text += fmt::format("<tr><td>{}</td>", escape_html(row.resolution.name));
    for (const std::string& value :
         {fmt::format("{:.4g}", r.cell_size), measured ? whole_figure(r.measured.value) : "-",
          whole_figure(r.measured.reference), measured ? figure(r.measured.error) : "-",
          figure(max_error_of(row.one, row.resolution)), order(r.order), order(r.fitted_order),
          order(row.one.min_order)})
      text += "<td>" + value + "</td>";
    text +=
        verdict_cell(r) + fmt::format("<td>{:.1f}{}</td>", r.wall_seconds, r.cached || r.recorded ? " (earlier)" : "");
    text += fmt::format("<td>{}</td></tr>\n", escape_html(measured ? row.resolution.others : r.message));
  }
  return text + "</table>\n";
}

// Finest run that was measured and whose output exists.
const ReportedResult* finest(const std::vector<ReportedResult>& rows) {
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    if (is_measured(row->result) && !row->result.recorded) return &*row;
  return nullptr;
}

std::string picture_of(const std::vector<ReportedResult>& rows) {
  const ReportedResult* row = finest(rows);
  if (!row) return {};
  const Picture picture = last_picture(row->result.run);
  if (picture.png.empty()) return fmt::format("<p>No picture: {}.</p>\n", escape_html(picture.reason));
  return fmt::format("<div><img alt='last frame of {} {}' src='data:image/png;base64,{}'></div>\n", row->one.name,
                     row->resolution.name, encode_base64(picture.png));
}

std::string page_of(const CaseSpec& one) {
  try {
    return "<pre>" + escape_html(read_whole_file(one.folder / "README.md")) + "</pre>\n";
  } catch (const Error&) {
    return {};
  }
}

std::string section_of(const Report& report, const std::vector<ReportedResult>& rows) {
  const CaseSpec& one = rows[0].one;
  std::string text = fmt::format("<h2 id='{0}'>{1}</h2>\n<p><code>{2}</code></p>\n", one.name, escape_html(one.title),
                                 escape_html(command_of(report, one)));
  text += html_table(rows);
  const bool passed =
      std::ranges::all_of(rows, [](const ReportedResult& row) { return row.result.verdict == Verdict::passed; });
  if (const std::string why = words_on_misses(rows); !why.empty())
    text += fmt::format("<p{}>{}</p>", passed ? "" : " class='miss'", escape_html(why));
  if (!one.others.empty()) text += "<p>Others: " + escape_html(one.others) + ".</p>\n";
  text += "<div class='row'>";
  for (const Chart& chart : {error_chart(rows), share_chart(rows), series_chart(rows)})
    if (const std::string svg = format_svg(chart); !svg.empty()) text += "<div>" + svg + "</div>\n";
  return text + picture_of(rows) + "</div>\n" + page_of(one);
}

std::string contents_of(const Report& report) {
  std::string text = "<table><tr><th>case</th><th>run</th><th>error</th><th>bar</th><th></th></tr>\n";
  for (const ReportedResult& row : report.results)
    text +=
        fmt::format("<tr><td><a href='#{0}'>{0}</a></td><td>{1}</td><td>{2}</td><td>{3}</td>{4}</tr>\n", row.one.name,
                    row.resolution.name, is_measured(row.result) ? figure(row.result.measured.error) : "-",
                    figure(max_error_of(row.one, row.resolution)), verdict_cell(row.result));
  return text + "</table>\n";
}

}  // namespace

std::string format_html(const Report& report) {
  std::string text = head;
  text += fmt::format("<h1>Validation</h1>\n<p>Seiche {}, build {}, level {}, {} rank{}: {}.</p>\n", version(),
                      build_digest(), report.level, report.ranks, report.ranks == 1 ? "" : "s", table_summary(report));
  if (!report.perturbation.empty())
    text += fmt::format(
        "<p class='miss'>Operators broken on purpose, for a test: {}. No figure here is the program's.</p>\n",
        escape_html(report.perturbation));
  text += fmt::format("<p>This machine: {}.</p>\n", escape_html(report.machine));
  text += contents_of(report);
  for (const auto& rows : by_case(report)) text += section_of(report, rows);
  return text + "</body></html>\n";
}

}  // namespace seiche
