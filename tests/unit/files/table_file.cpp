#include "files/table_file.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "base/crc32c.h"
#include "base/error.h"
#include "run/tables.h"
#include "unit/files/scratch.h"

namespace table_file_tests {
using namespace seiche;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

void overwrite(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

}  // namespace

TEST_CASE("a checksum goes on where the one before ended") {
  const std::string text = "the quick brown fox jumps over the lazy dog";
  for (std::size_t cut = 0; cut <= text.size(); ++cut)
    CHECK(crc32c(text.substr(cut), crc32c(text.substr(0, cut))) == crc32c(text));
}

TEST_CASE("the mark of a table is that of its bytes, also after it is opened again") {
  const ScratchFolder folder;
  const fs::path path = folder / "t.csv";
  TableMark first;
  {
    TableFile table(path, 0, "a,b\n");
    table.append("1,2\n");
    table.flush();
    first = table.mark();
    table.append("3,4\n");
    table.flush();
  }
  CHECK(first.bytes == 8);
  CHECK(first.checksum == crc32c("a,b\n1,2\n"));
  CHECK(fault_of_table(path, first).empty());  // rows after the mark are ignored
  TableFile again(path, first.bytes, "a,b\n");
  CHECK(again.mark().checksum == first.checksum);
}

TEST_CASE("missing, short and changed tables are told") {
  const ScratchFolder folder;
  const fs::path path = folder / "t.csv";
  const std::string text = "a,b\n1,2\n3,4\n";
  const TableMark mark{text.size(), crc32c(text)};
  CHECK_THAT(fault_of_table(path, mark), Contains("is missing"));
  overwrite(path, text.substr(0, 10));
  CHECK_THAT(fault_of_table(path, mark), Contains("has 10 bytes where the run had written 12"));
  CHECK(whole_lines(path, 12) == 8);
  overwrite(path, "a,b\n1,9\n3,4\n");
  CHECK_THAT(fault_of_table(path, mark), Contains("its checksum differs"));
  CHECK(fault_of_table(path, {text.size(), std::nullopt}).empty());
}

TEST_CASE("damaged tables stop a resume, and forced they are cut to whole lines") {
  const ScratchFolder folder;
  const RunPaths paths{folder.path()};
  const std::string text = "a,b\n1,2\n3,4\n";
  RunState state;
  state.frame = 0;
  for (const char* name : {"stats.csv", "solids.csv", "probes.csv"}) {
    overwrite(folder / name, text);
    state.table_checksums[name] = crc32c(text);
  }
  state.stats_bytes = state.solids_bytes = state.probes_bytes = text.size();
  CHECK(verify_tables(paths, EditPolicy::refuse, state).empty());
  overwrite(paths.stats(), text.substr(0, 10));
  fs::remove(paths.probes());
  RunState refused = state;
  try {
    verify_tables(paths, EditPolicy::refuse, refused);
    FAIL("damage was taken");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::bad_checkpoint);
    CHECK_THAT(error.what(),
               Contains("stats.csv has 10 bytes") && Contains("probes.csv is missing") && Contains("--force"));
  }
  CHECK(verify_tables(paths, EditPolicy::force, state).size() == 2);
  CHECK(state.stats_bytes == 8);
  CHECK(state.solids_bytes == 12);
  CHECK(state.probes_bytes == 0);
}

TEST_CASE("a table that was removed or replaced while it grows is an output error") {
  const ScratchFolder folder;
  TableFile table(folder / "t.csv", 0, "a\n");
  table.sync();
  fs::remove(folder / "t.csv");
  table.append("1\n");
  CHECK_THROWS_AS(table.sync(), Error);
  overwrite(folder / "t.csv", "a\n");
  CHECK_THROWS_AS(table.sync(), Error);
}

}  // namespace table_file_tests
