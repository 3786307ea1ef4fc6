#include "io/validate_record.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "base/error.h"
#include "io/checked_file.h"
#include "io/checkpoint_crc.h"
#include "io/scene_writer.h"
#include "io/validate_cache.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

constexpr const char* header = "case,resolution,identity,build,date,ranks,seconds,value,error,reference";
constexpr const char* comment = "# Written by seiche validate --record; see docs/validating.md.\n";

std::string text_of(const MeasureSpec& m) {
  std::string text = fmt::format("{} {} {} {} {} {} {} {}", m.kind, fmt::join(m.velocity, ";"), m.region, m.surface,
                                 m.probe, m.minus, m.column, m.solid);
  text +=
      fmt::format(" {} {} {} {} {} {:a} {:a}", m.level, m.reference, m.time_unit, m.length_unit, m.unit, m.from, m.to);
  return m.data.empty() ? text : text + " " + checksum_of(m.data);
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    fields.push_back(line.substr(at, end - at));
    at = end + 1;
  }
  return fields;
}

// A whole field as a number; `good` is cleared where it is none.
double number(const std::string& field, bool& good) {
  char* end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  good = good && !field.empty() && *end == '\0';
  return value;
}

// Of the fields from the fourth on; nothing where they are no run's.
std::optional<RecordedRun> run_of(const std::vector<std::string>& f) {
  if (f.size() != 10) return std::nullopt;
  bool good = true;
  RecordedRun run;
  run.origin = {f[3], f[4], int(number(f[5], good))};
  run.seconds = number(f[6], good);
  run.measured.value = number(f[7], good);
  run.measured.error = number(f[8], good);
  if (!f[9].empty()) run.measured.reference = number(f[9], good);
  return good ? std::optional(run) : std::nullopt;
}

}  // namespace

std::string measured_identity(const Scene& scene, const MeasureSpec& measure) {
  Scene without_folders = scene;
  for_each_shape(without_folders, [](ShapeSpec& shape) { shape.file = shape.file.filename(); });
  const std::string text = write_scene(without_folders) + checksums_of_files(scene) + text_of(measure);
  return fmt::format("{:08x}", crc32c(text));
}

ValidationRecord::ValidationRecord(fs::path file) : file_(std::move(file)) {
  if (!fs::exists(file_)) return;
  const std::string text = read_whole_file(file_);
  int count = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1, ++count;
    if (line.empty() || line[0] == '#' || line == header) continue;
    const std::vector<std::string> fields = fields_of(line);
    const auto run = run_of(fields);
    if (!run)
      throw Error(ExitCode::bad_input,
                  fmt::format("{}, line {}: not a row of a record ({})", file_.string(), count, header));
    rows_[{fields[0], fields[1]}] = {fields[2], *run};
  }
}

std::optional<RecordedRun> ValidationRecord::find(const std::string& one, const std::string& resolution,
                                                  const std::string& identity) const {
  const auto found = rows_.find({one, resolution});
  if (found == rows_.end() || found->second.identity != identity) return std::nullopt;
  return found->second.run;
}

void ValidationRecord::put(const std::string& one, const std::string& resolution, const std::string& identity,
                           const RecordedRun& run) {
  rows_[{one, resolution}] = {identity, run};
}

void ValidationRecord::write() const {
  std::string text = comment + std::string(header) + "\n";
  for (const auto& [name, row] : rows_) {
    const RecordedRun& r = row.run;
    text += fmt::format("{},{},{},{},{},{},{:.1f},{:.17g},{:.17g},{}\n", name.first, name.second, row.identity,
                        r.origin.build, r.origin.date, r.origin.ranks, r.seconds, r.measured.value, r.measured.error,
                        r.measured.reference ? fmt::format("{:.17g}", *r.measured.reference) : "");
  }
  write_file(file_, text);
}

std::string date_of(const fs::path& file) {
  std::error_code failed;
  const auto when = fs::last_write_time(file, failed);
  if (failed) return {};
  const auto time = std::chrono::system_clock::to_time_t(std::chrono::file_clock::to_sys(when));
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(time));
}

}  // namespace seiche
