#pragma once
// The rows of the table of measures, by what they read.
#include <cmath>
#include <vector>

#include "validate/measure/measures.h"

namespace seiche {

// What a measure reads.
enum class MeasureSource { frames, probes, stats, solids };

struct MeasureKind {
  const char* name;
  std::vector<const char*> keys;  // of [measure], all required
  Measurement (*measure)(const MeasureSpec&, const RunPaths&);
  Points (*series)(const MeasureSpec&, const RunPaths&) = nullptr;
  MeasureSource source = MeasureSource::frames;  // filled by measure_kinds()
};

// The whole table.
const std::vector<MeasureKind>& measure_kinds();

// The measure's row. Throws Error(bug) where there is none.
const MeasureKind& kind_of(const MeasureSpec& spec);

bool uses(const MeasureKind& kind, const std::string& key);

std::vector<MeasureKind> measures_of_frames();
std::vector<MeasureKind> measures_of_probes();   // probes.csv
std::vector<MeasureKind> measures_of_columns();  // stats.csv, summary.json
std::vector<MeasureKind> measures_of_solids();   // solids.csv

inline Measurement against(double value, double reference) {
  return {value, reference, std::abs(value / reference - 1)};
}

inline Measurement itself(double error) {
  return {error, {}, error};
}

}  // namespace seiche
