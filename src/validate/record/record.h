#pragma once
// Figures of runs made before, by whatever build: a validation that takes longer than a machine is free is made in
// parts.
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "base/scene.h"
#include "validate/case/case.h"
#include "validate/measure/measures.h"

namespace seiche {

// Who made a run, when and on what.
struct Origin {
  std::string build;  // digest, see base/version.h
  std::string date;   // UTC, such as 2026-11-22
  int ranks = 1;
  int threads = 0;      // of a rank; 0: not known
  std::string machine;  // see machine.h; empty: not known
};

struct RecordedRun {
  Origin origin;
  double seconds = 0;
  Measurement measured;
  std::string failure;  // why there is no figure; empty: there is one
};

struct RecordedRow {
  std::string one, resolution;  // names of the case and its run
  std::string identity;         // see measured_identity()
  RecordedRun run;
};

// A checksum of what is run and how it is measured: the scene, the bytes of the files it names (not where they lie),
// the measure and its data. Throws Error(bad_input) where such a file cannot be read.
std::string measured_identity(const Scene& scene, const MeasureSpec& measure);

// CSV: one row a run, by case and resolution, with the identity of what was measured. Rows of older records, without
// threads, machine and failure, are read as well.
class ValidationRecord {
 public:
  // `file` is for messages. Throws Error(bad_input) naming it and the line that is no row.
  ValidationRecord(const std::filesystem::path& file, const std::string& text);
  // What is there of a run, where it is of this identity.
  std::optional<RecordedRun> find(const std::string& one, const std::string& resolution,
                                  const std::string& identity) const;
  // In the place of what there is of this case and resolution.
  void put(const RecordedRow& row);
  std::string text() const;

 private:
  std::map<std::pair<std::string, std::string>, RecordedRow> rows_;
};

// The text of a record's file; empty where there is none. Throws Error(bad_input).
std::string read_record(const std::filesystem::path& file);

// Puts the row into the file as it is now: other validations may write to it at the same time. Returns the new text.
// Throws Error(bad_input, output_failed).
std::string put_on_file(const std::filesystem::path& file, const RecordedRow& row);

// The day (UTC) on which a file was last written; empty where that cannot be told.
std::string date_of(const std::filesystem::path& file);
std::string today();  // UTC

}  // namespace seiche
