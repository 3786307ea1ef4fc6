#pragma once
// Record of earlier runs' figures, of any build, so that a long validation can be done in parts.
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validate/case/case.h"
#include "validate/measure/measures.h"

namespace seiche {

struct Scene;

// Origin of a run: build, date, ranks and machine.
struct Origin {
  std::string build;  // digest, see base/version.h
  std::string date;   // UTC, such as 2026-11-22
  int ranks = 1;
  int threads = 0;      // per rank; 0: unknown
  std::string machine;  // see machine.h; empty: unknown
};

struct RecordedRun {
  Origin origin;
  double seconds = 0;
  Measurement measured;
  std::string failure;  // reason if there is no figure; else empty
};

struct RecordedRow {
  std::string one, resolution;  // names of the case and of the run
  std::string identity;         // see measured_identity()
  RecordedRun run;
};

// Checksum of scene and measure: the scene, the contents of its files (not their location), the measure and its data.
// Throws Error(bad_input) if such a file is unreadable.
std::string measured_identity(const Scene& scene, const MeasureSpec& measure);
// The same before scenes had some of today's keys, which are at their defaults: rows of then still count.
std::vector<std::string> older_identities(const Scene& scene, const MeasureSpec& measure);

// CSV with one row a run, by case and resolution, with the identity of the measurement. Also reads older records
// without threads, machine and failure.
class ValidationRecord {
 public:
  // `file` is for messages. Throws Error(bad_input) naming it and an invalid line.
  ValidationRecord(const std::filesystem::path& file, const std::string& text);
  // Recorded figures of a run, if they have this identity.
  std::optional<RecordedRun> find(const std::string& one, const std::string& resolution,
                                  const std::string& identity) const;
  // Replaces the row of this case and resolution.
  void put(const RecordedRow& row);
  std::string text() const;

 private:
  std::map<std::pair<std::string, std::string>, RecordedRow> rows_;
};

// Text of a record's file; empty if there is none. Throws Error(bad_input).
std::string read_record(const std::filesystem::path& file);

// Inserts the row into the present contents of the file, which concurrent validations may change. Returns the new text.
// Throws Error(bad_input, output_failed).
std::string put_on_file(const std::filesystem::path& file, const RecordedRow& row);

// Day (UTC) of the last change of a file; empty if unknown.
std::string date_of(const std::filesystem::path& file);
std::string today();  // UTC

}  // namespace seiche
