#pragma once
// Figures of runs made before, by whatever build: a validation that takes longer than a machine is free is made in
// parts.
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "base/scene.h"
#include "io/validate_case.h"
#include "io/validate_measures.h"

namespace seiche {

// Who made a run, and when.
struct Origin {
  std::string build;  // digest, see base/version.h
  std::string date;   // UTC, such as 2026-11-22
  int ranks = 1;
};

struct RecordedRun {
  Origin origin;
  double seconds = 0;
  Measurement measured;
};

// A checksum of what is run and how it is measured: the scene, the bytes of the files it names (not where they lie),
// the measure and its data. Throws Error(bad_input) where such a file cannot be read.
std::string measured_identity(const Scene& scene, const MeasureSpec& measure);

// A CSV file: one row a run, by case and resolution, with the identity of what was measured.
class ValidationRecord {
 public:
  // Reads the file where there is one. Throws Error(bad_input) naming it and the line that is no row.
  explicit ValidationRecord(std::filesystem::path file);
  // The figures of a run, where they are of this identity.
  std::optional<RecordedRun> find(const std::string& one, const std::string& resolution,
                                  const std::string& identity) const;
  // In the place of what there is of this case and resolution.
  void put(const std::string& one, const std::string& resolution, const std::string& identity, const RecordedRun& run);
  // Throws Error(output_failed).
  void write() const;

 private:
  struct Row {
    std::string identity;
    RecordedRun run;
  };
  std::filesystem::path file_;
  std::map<std::pair<std::string, std::string>, Row> rows_;
};

// The day (UTC) on which a file was last written; empty where that cannot be told.
std::string date_of(const std::filesystem::path& file);

}  // namespace seiche
