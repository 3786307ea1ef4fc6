#pragma once
// Rows of the table of measures, grouped by their source.
#include <cmath>
#include <vector>

#include "validate/measure/measures.h"

namespace seiche {

// Output that a measure reads.
enum class MeasureSource { frames, probes, stats, solids };

struct MeasureKind {
  const char* name;
  std::vector<const char*> keys;  // keys of [measure], all required
  Measurement (*measure)(const MeasureSpec&, const RunPaths&);
  Points (*series)(const MeasureSpec&, const RunPaths&) = nullptr;
  MeasureSource source = MeasureSource::frames;  // filled by measure_kinds()
};

// The whole table.
const std::vector<MeasureKind>& measure_kinds();

// Row of the measure. Throws Error(bug) if there is none.
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
