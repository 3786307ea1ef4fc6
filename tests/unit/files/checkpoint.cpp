#include "files/checkpoint.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "base/checkpoint_boxes.h"
#include "base/crc32c.h"
#include "base/error.h"
#include "files/checkpoint_commit.h"
#include "files/checkpoint_file.h"
#include "unit/files/scratch.h"

namespace checkpoint_tests {
using namespace seiche;

namespace {

double value_at(int i, int j, int k) {
  return i + 100.0 * j + 10000.0 * k;
}

FieldRecord field(const std::string& name, std::array<int, 3> lower, std::array<int, 3> upper) {
  FieldRecord f{name, lower, upper, {}};
  for (int k = lower[2]; k < upper[2]; ++k) {
    for (int j = lower[1]; j < upper[1]; ++j) {
      for (int i = lower[0]; i < upper[0]; ++i) f.values.push_back(value_at(i, j, k));
    }
  }
  return f;
}

CheckpointData sample() {
  CheckpointData data;
  data.scalars = {{"time", 0.1}, {"tiny", 5e-324}, {"minus zero", -0.0}, {"third", 1.0 / 3}};
  data.texts = {{"note", "a\nb"}, {"empty", ""}};
  data.fields = {field("p", {0, 0, 0}, {4, 3, 2}), field("u", {-1, 0, 0}, {4, 3, 2}),
                 field("none", {2, 2, 2}, {2, 2, 2})};
  return data;
}

bool equal(const CheckpointData& a, const CheckpointData& b) {
  bool same = a.scalars.size() == b.scalars.size() && a.texts == b.texts && a.fields.size() == b.fields.size();
  for (const auto& [name, value] : a.scalars)
    same = same && std::memcmp(&value, &b.scalars.at(name), sizeof value) == 0;
  for (std::size_t n = 0; same && n < a.fields.size(); ++n) {
    const FieldRecord &f = a.fields[n], &g = b.fields[n];
    same = f.name == g.name && f.lower == g.lower && f.upper == g.upper && f.values == g.values;
  }
  return same;
}

std::string encoded(const CheckpointHeader& header) {
  std::string bytes;
  const WrittenBytes written = write_checkpoint_file(header, sample(), [&](std::string_view piece) { bytes += piece; });
  CHECK(written.count == bytes.size());
  CHECK(written.checksum == crc32c(bytes));
  return bytes;
}

ExitCode code_of_finding(const std::filesystem::path& folder, std::vector<std::string>& warnings) {
  try {
    find_newest_checkpoint(folder, Communicator(), warnings);
    return ExitCode::done;
  } catch (const Error& error) {
    return error.code();
  }
}

std::string patched(std::string bytes, std::size_t at, std::uint32_t value) {
  std::memcpy(bytes.data() + at, &value, 4);
  const std::uint32_t sum = crc32c(std::string_view(bytes).substr(0, bytes.size() - 4));
  std::memcpy(bytes.data() + bytes.size() - 4, &sum, 4);
  return bytes;
}

}  // namespace

TEST_CASE("CRC-32C gives the published check values") {
  CHECK(crc32c("123456789") == 0xe3069283u);              // the check value of the Castagnoli polynomial
  CHECK(crc32c(std::string(32, '\0')) == 0x8a9136aau);    // RFC 3720, B.4
  CHECK(crc32c(std::string(32, '\xff')) == 0x62a8ab43u);  // RFC 3720, B.4
  CHECK(crc32c("") == 0);
}

TEST_CASE("checkpoint bytes decode to the same data and encode to the same bytes") {
  const std::string bytes = encoded({3, 1, 4, 77, "hash", "creator"});
  const CheckpointFile back = decode_checkpoint_file(bytes);
  CHECK(equal(back.data, sample()));
  CHECK(back.header.step == 77);
  CHECK(back.header.rank == 1);
  CHECK(encoded(back.header) == bytes);
}

// As programs before format 2 wrote it: the count of values, then each of them.
TEST_CASE("a checkpoint file of format 1 is read") {
  const auto put_in = [](std::string& bytes, const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  std::string bytes = "SEICHECP";
  for (const std::uint32_t word : {0x01020304u, 1u, 8u, 0u}) put_in(bytes, word);
  for (const std::int32_t number : {2, 0, 1}) put_in(bytes, number);
  put_in(bytes, std::int64_t(9));
  for (int text = 0; text < 2; ++text) put_in(bytes, std::uint64_t(0));
  for (const std::uint64_t count : {0, 0, 1, 1}) put_in(bytes, count);  // scalars, texts, fields, length of a name
  bytes += "p";
  for (const std::int32_t bound : {0, 0, 0, 2, 2, 1}) put_in(bytes, bound);
  put_in(bytes, std::uint64_t(4));
  for (const double value : {0.5, 0.5, 0.5, -2.0}) put_in(bytes, value);
  put_in(bytes, crc32c(bytes));
  const CheckpointFile file = decode_checkpoint_file(bytes);
  CHECK(file.header.step == 9);
  REQUIRE(file.data.fields.size() == 1);
  CHECK(file.data.fields[0].values.unpack() == std::vector<double>{0.5, 0.5, 0.5, -2});
}

TEST_CASE("every flipped byte and every shortening of a checkpoint file is noticed") {
  const std::string bytes = encoded({3, 0, 1, 5, "hash", "creator"});
  int unnoticed = 0;
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    std::string changed = bytes;
    changed[n] = char(changed[n] ^ 0x10);
    unnoticed += examine_checkpoint_file(changed).kind == CheckpointDefect::Kind::none;
    unnoticed += examine_checkpoint_file(bytes.substr(0, n)).kind == CheckpointDefect::Kind::none;
  }
  CHECK(unnoticed == 0);
}

TEST_CASE("an intact checkpoint of another version, byte order or precision is foreign, with both named") {
  const std::string bytes = encoded({3, 0, 1, 5, "hash", "creator"});
  const auto defect = [&](std::size_t at, std::uint32_t value) {
    return examine_checkpoint_file(patched(bytes, at, value));
  };
  CHECK(defect(8, 0x04030201).kind == CheckpointDefect::Kind::foreign);
  CHECK(defect(12, 99).kind == CheckpointDefect::Kind::foreign);
  CHECK(defect(12, 99).text.find("format 99") != std::string::npos);
  CHECK(defect(12, 99).text.find("format 2") != std::string::npos);
  CHECK(defect(16, 4).kind == CheckpointDefect::Kind::foreign);
}

TEST_CASE("boxes cut from other boxes hold the same entries") {
  // Two old slabs along z, three new slabs along x.
  const std::vector<FieldRecord> old{field("p", {0, 0, 0}, {7, 5, 1}), field("p", {0, 0, 1}, {7, 5, 4})};
  for (const auto& [low, high] : {std::pair{0, 2}, std::pair{2, 3}, std::pair{3, 7}}) {
    BoxFiller filler({{"p", {low, 0, 0}, {high, 5, 4}, {}}});
    filler.take(old[0]);
    CHECK_FALSE(filler.complete());
    filler.take(old[1]);
    CHECK(filler.complete());
    const std::vector<FieldRecord> cut = std::move(filler).result();
    CHECK(cut[0].values == field("p", {low, 0, 0}, {high, 5, 4}).values);
  }
}

TEST_CASE("the newest two checkpoints are kept and the newest is found") {
  const ScratchFolder folder;
  const Communicator ranks;
  for (const std::int64_t step : {0, 10, 20, 30}) write_checkpoint(folder.path(), {step, 3, "h"}, sample(), ranks);
  CHECK(entries(folder.path()) == 2);
  std::vector<std::string> warnings;
  const FoundCheckpoint found = find_newest_checkpoint(folder.path(), ranks, warnings);
  CHECK(found.label.step == 30);
  CHECK(warnings.empty());
  CHECK(equal(load_checkpoint(found, sample().fields, ranks), sample()));
}

TEST_CASE("a damaged checkpoint is passed over for the one before; with none left there is an error") {
  const ScratchFolder folder;
  const Communicator ranks;
  const std::string damage = GENERATE("flip", "truncate", "commit", "missing", "no commit", "swap");
  for (const std::int64_t step : {10, 20}) write_checkpoint(folder.path(), {step, 3, "h"}, sample(), ranks);
  const auto spoil = [&](const std::string& name) {
    const auto file = folder.path() / name / "rank.00000", commit = folder.path() / name / "COMMIT";
    std::string bytes = contents(file);
    if (damage == "flip") bytes[bytes.size() / 2] ^= 1;
    if (damage == "truncate") bytes.resize(bytes.size() / 2);
    if (damage == "swap") bytes = encoded({3, 1, 2, 20, "h", "c"});
    if (damage == "commit") put(commit, contents(commit) + "x");
    if (damage == "no commit") std::filesystem::remove(commit);
    put(file, bytes);
    if (damage == "missing") std::filesystem::remove(file);
  };
  spoil("00000020");
  std::vector<std::string> warnings;
  CHECK(find_newest_checkpoint(folder.path(), ranks, warnings).label.step == 10);
  CHECK(warnings.size() == 1);
  spoil("00000010");
  CHECK(code_of_finding(folder.path(), warnings) == ExitCode::bad_checkpoint);
}

TEST_CASE("extra files in a checkpoint change nothing") {
  const ScratchFolder folder;
  const Communicator ranks;
  write_checkpoint(folder.path(), {10, 3, "h"}, sample(), ranks);
  put(folder.path() / "00000010/rank.00001", "stranger");
  std::vector<std::string> warnings;
  CHECK(
      equal(load_checkpoint(find_newest_checkpoint(folder.path(), ranks, warnings), sample().fields, ranks), sample()));
}

TEST_CASE("a checkpoint with a value that is not a number is not written") {
  const ScratchFolder folder;
  CheckpointData data = sample();
  std::vector<double> values = data.fields[0].values.unpack();
  values[5] = std::numeric_limits<double>::quiet_NaN();
  data.fields[0].values = PackedValues(values);
  try {
    write_checkpoint(folder.path(), {10, 3, "h"}, data, Communicator());
    FAIL("was written");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::cannot_continue);
    CHECK(std::string(error.what()).find("p at (1, 1, 0)") != std::string::npos);
  }
  CHECK(entries(folder.path()) == 0);
}

TEST_CASE("a COMMIT file reads back and any change of it is noticed") {
  const std::string text = format_commit({1, 12, {{"rank.00000", 100, 0xdeadbeef}, {"rank.00001", 7, 1}}});
  const auto commit = parse_commit(text);
  REQUIRE(commit);
  CHECK(commit->step == 12);
  CHECK(commit->files[0].checksum == 0xdeadbeef);
  CHECK(commit->files[1].bytes == 7);
  for (std::size_t n = 0; n < text.size(); ++n) {
    std::string changed = text;
    changed[n] ^= 1;
    CHECK_FALSE(parse_commit(changed));
  }
}

}  // namespace checkpoint_tests
