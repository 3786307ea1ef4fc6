#include "validate/record/record.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/crc32c.h"
#include "base/error.h"
#include "base/scene.h"
#include "files/checked_file.h"
#include "scene/writer.h"
#include "validate/record/cache.h"
#include "validate/record/files.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

constexpr const char* older_header = "case,resolution,identity,build,date,ranks,seconds,value,error,reference";
constexpr const char* header =
    "case,resolution,identity,build,date,ranks,seconds,value,error,reference,threads,machine,failure";
constexpr const char* comment = "# Written by seiche validate --record; see docs/validating.md.\n";

std::string text_of(const MeasureSpec& m) {
  std::string text = fmt::format("{} {} {} {} {} {} {} {}", m.kind, fmt::join(m.velocity, ";"), m.region, m.surface,
                                 m.probe, m.minus, m.column, m.solid);
  text +=
      fmt::format(" {} {} {} {} {} {:a} {:a}", m.level, m.reference, m.time_unit, m.length_unit, m.unit, m.from, m.to);
  return m.data.empty() ? text : text + " " + checksum_of(m.data);
}

// CSV field on one line, in quotes if necessary.
std::string field_of(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t n = 0; n < line.size(); ++n) {
    const bool twice = quoted && line.compare(n, 2, "\"\"") == 0;
    if (line[n] == ',' && !quoted) {
      fields.emplace_back();
    } else if (line[n] == '"' && !twice) {
      quoted = !quoted;
    } else {
      fields.back() += line[n];
      n += twice;
    }
  }
  return fields;
}

// The whole field as a finite number; otherwise clears `good`.
double number(const std::string& field, bool& good) {
  char* end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  good = good && !field.empty() && *end == '\0' && std::isfinite(value);
  return value;
}

// The same for a count.
int count_in(const std::string& field, bool& good) {
  const double value = number(field, good);
  good = good && value >= 1 && value <= std::numeric_limits<int>::max() && value == std::floor(value);
  return good ? int(value) : 0;
}

// Empty if the fields are not a valid row.
std::optional<RecordedRow> row_of(const std::vector<std::string>& f) {
  if (f.size() != 10 && f.size() != 13) return std::nullopt;
  bool good = true;
  RecordedRow row{f[0], f[1], f[2], {}};
  RecordedRun& run = row.run;
  run.origin = {f[3], f[4], count_in(f[5], good), 0, ""};
  run.seconds = number(f[6], good);
  if (f.size() == 13) {
    if (!f[10].empty()) run.origin.threads = count_in(f[10], good);
    run.origin.machine = f[11];
    run.failure = f[12];
  }
  if (!run.failure.empty()) return good ? std::optional(row) : std::nullopt;
  run.measured.value = number(f[7], good);
  run.measured.error = number(f[8], good);
  good = good && run.measured.error >= 0;
  if (!f[9].empty()) run.measured.reference = number(f[9], good);
  return good ? std::optional(row) : std::nullopt;
}

// "value,error,reference"
std::string figures_of(const RecordedRun& run) {
  if (!run.failure.empty()) return ",,";
  const Measurement& m = run.measured;
  return fmt::format("{:.17g},{:.17g},{}", m.value, m.error, m.reference ? fmt::format("{:.17g}", *m.reference) : "");
}

std::string day_of(std::chrono::system_clock::time_point time) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

// Lines of scenes at the defaults of keys that came after the first records, the newest first.
constexpr const char* later_lines[] = {"spray = true", "up = \"scene\"", "velocity_name = \"vel\"", "volume = \"auto\"",
                                       "surface = \"closed\""};

std::string text_of(const Scene& scene) {
  Scene without_folders = scene;
  for_each_shape(without_folders, [](ShapeSpec& shape) { shape.file = shape.file.filename(); });
  return write_scene(without_folders);
}

std::string rest_of(const Scene& scene, const MeasureSpec& measure) {
  return checksums_of_files(scene) + text_of(measure);
}

std::string checksum_of_text(const std::string& text) {
  return fmt::format("{:08x}", crc32c(text));
}

}  // namespace

std::string measured_identity(const Scene& scene, const MeasureSpec& measure) {
  return checksum_of_text(text_of(scene) + rest_of(scene, measure));
}

std::vector<std::string> older_identities(const Scene& scene, const MeasureSpec& measure) {
  std::string text = text_of(scene);
  const std::string rest = rest_of(scene, measure);
  std::vector<std::string> identities;
  for (const char* line : later_lines) {
    const std::size_t at = text.find(fmt::format("\n{}\n", line));
    if (at == std::string::npos) continue;
    text.erase(at, std::string(line).size() + 1);
    identities.push_back(checksum_of_text(text + rest));
  }
  return identities;
}

ValidationRecord::ValidationRecord(const fs::path& file, const std::string& text) {
  int count = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1, ++count;
    if (line.empty() || line[0] == '#' || line == header || line == older_header) continue;
    const auto row = row_of(fields_of(line));
    if (!row)
      throw Error(ExitCode::bad_input,
                  fmt::format("{}, line {}: not a row of a record ({})", file.string(), count, header));
    if (rows_.contains({row->one, row->resolution}))
      throw Error(ExitCode::bad_input, fmt::format("{}, line {}: a second row of {}/{}: leave one", file.string(),
                                                   count, row->one, row->resolution));
    put(*row);
  }
}

std::optional<RecordedRun> ValidationRecord::find(const std::string& one, const std::string& resolution,
                                                  const std::string& identity) const {
  const auto found = rows_.find({one, resolution});
  if (found == rows_.end() || found->second.identity != identity) return std::nullopt;
  return found->second.run;
}

void ValidationRecord::put(const RecordedRow& row) {
  rows_[{row.one, row.resolution}] = row;
}

std::string ValidationRecord::text() const {
  std::string text = comment + std::string(header) + "\n";
  for (const auto& [name, row] : rows_) {
    const Origin& origin = row.run.origin;
    text += fmt::format("{},{},{},{},{},{},{:.1f},{},{},{},{}\n", row.one, row.resolution, row.identity, origin.build,
                        origin.date, origin.ranks, row.run.seconds, figures_of(row.run),
                        origin.threads > 0 ? std::to_string(origin.threads) : "", field_of(origin.machine),
                        field_of(row.run.failure));
  }
  return text;
}

std::string read_record(const fs::path& file) {
  if (!fs::exists(file)) return {};
  try {
    return read_whole_file(file);
  } catch (const Error& error) {
    throw Error(ExitCode::bad_input, error.what());
  }
}

std::string put_on_file(const fs::path& file, const RecordedRow& row) {
  const FolderLock lock(folder_of(file));
  ValidationRecord record(file, read_record(file));
  record.put(row);
  const std::string text = record.text();
  replace_file(file, text);
  return text;
}

std::string date_of(const fs::path& file) {
  std::error_code failed;
  const auto when = fs::last_write_time(file, failed);
  return failed ? std::string() : day_of(std::chrono::file_clock::to_sys(when));
}

std::string today() {
  return day_of(std::chrono::system_clock::now());
}

}  // namespace seiche
