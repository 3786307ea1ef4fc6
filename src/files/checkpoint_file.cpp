#include "files/checkpoint_file.h"

#include <fmt/format.h>

#include <cstring>
#include <type_traits>

#include "base/crc32c.h"
#include "base/error.h"

namespace seiche {
namespace {

constexpr char magic[8] = {'S', 'E', 'I', 'C', 'H', 'E', 'C', 'P'};
constexpr std::uint32_t endianness_tag = 0x01020304u;
constexpr std::uint32_t precision = sizeof(double);

struct Header {
  char magic[8];
  std::uint32_t endianness, version, precision, reserved;
};
static_assert(sizeof(Header) == 24);

class Writer {
 public:
  template <class T>
  void number(T value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(const std::string& value) {
    number(std::uint64_t(value.size()));
    bytes_ += value;
  }
  void numbers(const std::vector<double>& values) {
    number(std::uint64_t(values.size()));
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  }
  void raw(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  std::string take() { return std::move(bytes_); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// Checks every length against the available bytes before allocating.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  T number() {
    T value{};
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  std::string text() {
    const std::size_t size = count(1);
    return std::string(take(size), size);
  }
  std::vector<double> numbers() {
    const std::size_t size = count(sizeof(double));
    std::vector<double> values(size);
    const char* from = take(size * sizeof(double));
    if (size > 0) std::memcpy(values.data(), from, size * sizeof(double));
    return values;
  }
  std::size_t count(std::size_t bytes_each) {
    const auto n = number<std::uint64_t>();
    if (n > bytes_.size() / bytes_each) throw Error(ExitCode::bad_checkpoint, "a length points beyond the end");
    return std::size_t(n);
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  const char* take(std::size_t size) {
    if (size > bytes_.size()) throw Error(ExitCode::bad_checkpoint, "the data end early");
    const char* from = bytes_.data();
    bytes_.remove_prefix(size);
    return from;
  }

  std::string_view bytes_;
};

void write_field(Writer& out, const FieldRecord& field) {
  out.text(field.name);
  for (const int i : field.lower) out.number(std::int32_t(i));
  for (const int i : field.upper) out.number(std::int32_t(i));
  out.numbers(field.values);
}

FieldRecord read_field(Reader& in) {
  FieldRecord field;
  field.name = in.text();
  for (int& i : field.lower) i = in.number<std::int32_t>();
  for (int& i : field.upper) i = in.number<std::int32_t>();
  field.values = in.numbers();
  return field;
}

void write_data(Writer& out, const CheckpointData& data) {
  out.number(std::uint64_t(data.scalars.size()));
  for (const auto& [name, value] : data.scalars) {
    out.text(name);
    out.number(value);
  }
  out.number(std::uint64_t(data.texts.size()));
  for (const auto& [name, value] : data.texts) {
    out.text(name);
    out.text(value);
  }
  out.number(std::uint64_t(data.fields.size()));
  for (const FieldRecord& field : data.fields) write_field(out, field);
}

CheckpointData read_data(Reader& in) {
  CheckpointData data;
  for (std::size_t left = in.count(1); left > 0; --left) {
    const std::string name = in.text();
    data.scalars[name] = in.number<double>();
  }
  for (std::size_t left = in.count(1); left > 0; --left) {
    const std::string name = in.text();
    data.texts[name] = in.text();
  }
  for (std::size_t left = in.count(1); left > 0; --left) data.fields.push_back(read_field(in));
  return data;
}

Header header_of(const std::string& bytes) {
  Header header{};
  std::memcpy(&header, bytes.data(), sizeof header);
  return header;
}

CheckpointDefect foreign(const std::string& text) {
  return {CheckpointDefect::Kind::foreign, text};
}
CheckpointDefect damaged(const std::string& text) {
  return {CheckpointDefect::Kind::damaged, text};
}

}  // namespace

std::string encode_checkpoint_file(const CheckpointFile& file) {
  Header header{{}, endianness_tag, checkpoint_format_version, precision, 0};
  std::memcpy(header.magic, magic, sizeof magic);
  Writer out;
  out.raw(&header, sizeof header);
  out.number(std::int32_t(file.dimension));
  out.number(std::int32_t(file.rank));
  out.number(std::int32_t(file.ranks));
  out.number(file.step);
  out.text(file.scene_hash);
  out.text(file.creator);
  write_data(out, file.data);
  out.number(crc32c(out.bytes()));
  return out.take();
}

CheckpointDefect examine_checkpoint_file(const std::string& bytes) {
  if (bytes.size() < sizeof(Header) + 4) return damaged("it is too short");
  if (std::memcmp(bytes.data(), magic, sizeof magic) != 0)
    return damaged("it does not begin like a checkpoint of Seiche");
  const std::string_view covered(bytes.data(), bytes.size() - 4);
  unsigned char stored[4];
  std::memcpy(stored, bytes.data() + covered.size(), 4);
  const std::uint32_t sum = crc32c(covered);
  const std::uint32_t little = stored[0] | stored[1] << 8 | stored[2] << 16 | std::uint32_t(stored[3]) << 24;
  const std::uint32_t big = stored[3] | stored[2] << 8 | stored[1] << 16 | std::uint32_t(stored[0]) << 24;
  if (sum != little && sum != big) return damaged("its checksum does not match its contents");
  const Header header = header_of(bytes);
  if (header.endianness == __builtin_bswap32(endianness_tag)) {
    return foreign("it is big-endian and this machine is little-endian");
  }
  if (header.version != checkpoint_format_version) {
    return foreign(fmt::format("it has checkpoint format {} and this program reads format {}", header.version,
                               checkpoint_format_version));
  }
  if (header.endianness != endianness_tag) return foreign("its byte order is not this machine's (little-endian)");
  if (header.precision != precision) {
    return foreign(fmt::format("its numbers have {} bytes and this program's have {}", header.precision, precision));
  }
  return {};
}

CheckpointFile decode_checkpoint_file(const std::string& bytes) {
  const CheckpointDefect defect = examine_checkpoint_file(bytes);
  if (defect.kind != CheckpointDefect::Kind::none) throw Error(ExitCode::bad_checkpoint, defect.text);
  Reader in(std::string_view(bytes).substr(sizeof(Header), bytes.size() - sizeof(Header) - 4));
  CheckpointFile file;
  file.dimension = in.number<std::int32_t>();
  file.rank = in.number<std::int32_t>();
  file.ranks = in.number<std::int32_t>();
  file.step = in.number<std::int64_t>();
  file.scene_hash = in.text();
  file.creator = in.text();
  file.data = read_data(in);
  if (!in.at_end()) throw Error(ExitCode::bad_checkpoint, "data are left over at its end");
  return file;
}

}  // namespace seiche
