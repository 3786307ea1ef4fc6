#include "validate/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/version.h"
#include "files/json.h"

namespace seiche {
namespace {

std::string number(double value) {
  return fmt::format("{:.4g}", value);
}

std::string number(const std::optional<double>& value) {
  return value ? number(*value) : "-";
}

JsonValue json_result(const ReportedResult& row) {
  const CaseResult& r = row.result;
  const bool measured = is_measured(r);
  const auto if_measured = [&](double value) { return measured ? JsonValue(value) : JsonValue(); };
  return JsonMembers{{"resolution", row.resolution.name},
                     {"result", verdict_name(r.verdict)},
                     {"cell_size", r.cell_size},
                     {"unit", row.unit},
                     {"measured", if_measured(r.measured.value)},
                     {"reference", r.measured.reference},
                     {"error", if_measured(r.measured.error)},
                     {"max_error", max_error_of(row.one, row.resolution)},
                     {"order", r.order},
                     {"fitted_order", r.fitted_order},
                     {"min_order", row.one.min_order},
                     {"others", row.resolution.others},
                     {"wall_seconds", r.wall_seconds},
                     {"cached", r.cached},
                     {"recorded", r.recorded},
                     {"build", r.origin.build},
                     {"date", r.origin.date},
                     {"ranks", r.origin.ranks},
                     {"threads", r.origin.threads > 0 ? JsonValue(r.origin.threads) : JsonValue()},
                     {"machine", r.origin.machine},
                     {"run", r.run.string()},
                     {"message", r.message}};
}

JsonValue json_case(const std::vector<ReportedResult>& rows) {
  const CaseSpec& one = rows[0].one;
  JsonItems results;
  for (const ReportedResult& row : rows) results.push_back(json_result(row));
  return JsonMembers{{"name", one.name},
                     {"title", one.title},
                     {"tags", JsonItems(one.tags.begin(), one.tags.end())},
                     {"measure", one.measure.kind},
                     {"others", one.others},
                     {"known", one.known},
                     {"results", std::move(results)}};
}

JsonItems json_cases(const Report& report) {
  JsonItems cases;
  for (const auto& rows : by_case(report)) cases.push_back(json_case(rows));
  return cases;
}

// "12.3"; "(12.3)" for an earlier run.
std::string seconds(const CaseResult& r) {
  if (r.verdict == Verdict::absent) return "-";
  return r.cached || r.recorded ? fmt::format("({:.1f})", r.wall_seconds) : fmt::format("{:.1f}", r.wall_seconds);
}

std::ptrdiff_t count(const Report& report, Verdict verdict) {
  return std::count_if(report.results.begin(), report.results.end(),
                       [&](const ReportedResult& row) { return row.result.verdict == verdict; });
}

}  // namespace

std::string verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "pass";
    case Verdict::missed:
      return "MISS";
    case Verdict::absent:
      return "not run";
    default:
      return "FAILED";
  }
}

bool is_measured(const CaseResult& result) {
  return result.verdict == Verdict::passed || result.verdict == Verdict::missed;
}

std::vector<std::vector<ReportedResult>> by_case(const Report& report) {
  std::vector<std::vector<ReportedResult>> cases;
  for (const ReportedResult& row : report.results) {
    if (cases.empty() || cases.back()[0].one.name != row.one.name) cases.emplace_back();
    cases.back().push_back(row);
  }
  return cases;
}

std::string table_header(const TableWidths& w) {
  return fmt::format("{:<{}}  {:<{}}  {:>10}  {:>10}  {:>10}  {:>10}  {:>5}  {:>5}  {:>5}  {:<7}  {:>8}  {}", "case",
                     w.name, "resolution", w.resolution, "measured", "reference", "error", "bar", "order", "fit", "bar",
                     "", "seconds", "others report");
}

std::string table_row(const TableWidths& w, const ReportedResult& row) {
  const CaseResult& r = row.result;
  const bool measured = is_measured(r);
  const auto short_number = [](const std::optional<double>& v) { return v ? fmt::format("{:.2f}", *v) : "-"; };
  const std::string& why = r.message;
  return fmt::format("{:<{}}  {:<{}}  {:>10}  {:>10}  {:>10}  {:>10}  {:>5}  {:>5}  {:>5}  {:<7}  {:>8}  {}",
                     row.one.name, w.name, row.resolution.name, w.resolution, measured ? number(r.measured.value) : "-",
                     number(r.measured.reference), measured ? number(r.measured.error) : "-",
                     number(max_error_of(row.one, row.resolution)), short_number(r.order), short_number(r.fitted_order),
                     r.order ? short_number(row.one.min_order) : "-", verdict_name(r.verdict), seconds(r),
                     measured ? row.resolution.others : why.substr(0, why.find('\n')));
}

std::string table_summary(const Report& report) {
  std::string text = fmt::format("{} pass", count(report, Verdict::passed));
  for (const Verdict verdict : {Verdict::missed, Verdict::failed, Verdict::absent}) {
    if (const auto n = count(report, verdict)) text += fmt::format(", {} {}", n, verdict_name(verdict));
  }
  return text;
}

std::string format_report(const Report& report) {
  const bool complete = report.results.size() == report.planned;
  const bool passed = count(report, Verdict::passed) == std::ptrdiff_t(report.planned);
  return format_json(JsonMembers{{"version", version()},
                                 {"build", build_digest()},
                                 {"level", report.level},
                                 {"ranks", report.ranks},
                                 {"machine", report.machine},
                                 {"broken_on_purpose", report.perturbation.empty() ? JsonValue() : report.perturbation},
                                 {"complete", complete},
                                 {"passed", passed},
                                 {"cases", json_cases(report)}});
}

}  // namespace seiche
