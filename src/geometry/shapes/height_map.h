#pragma once
// Height maps: values on a rectangle of samples, from grey pictures or grids of numbers.
#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

// Values row by row from the top of the picture or the first line of the file.
struct HeightMap {
  int columns = 0, rows = 0;
  bool grey = false;  // true: from 0, black, to 1, white; false: numbers of the file, m
  std::vector<double> values;

  double at(int column, int row) const { return values[std::size_t(row) * std::size_t(columns) + std::size_t(column)]; }
};

// Most samples of a map: 128 MB of them.
constexpr std::int64_t most_map_samples = 1 << 24;

// Reads a .png (grey, of 8 or 16 bits), or numbers a line a row (.csv, .txt, apart by commas, semicolons or blanks;
// .asc with the header of an ESRI grid). Throws Error(bad_input) with the file, the place and the remedy.
HeightMap read_height_map(const std::filesystem::path& file);

// The file's reader for pictures.
HeightMap read_grey_png(const std::filesystem::path& file);

// Throws Error(bad_input) if a map of so many samples is too large or has fewer than two columns.
void require_map_size(const std::filesystem::path& file, std::int64_t columns, std::int64_t rows);

}  // namespace seiche
