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

struct FixedHeader {
  char magic[8];
  std::uint32_t endianness, version, precision, reserved;
};
static_assert(sizeof(FixedHeader) == 24);

// Collects small pieces before it passes them on.
class Writer {
 public:
  explicit Writer(const ByteSink& sink) : sink_(sink) {}

  template <class T>
  void number(T value) {
    static_assert(std::is_arithmetic_v<T>);
    raw(&value, sizeof value);
  }
  void text(const std::string& value) {
    number(std::uint64_t(value.size()));
    raw(value.data(), value.size());
  }
  void values(const PackedValues& packed) {
    number(std::uint64_t(packed.size()));
    number(std::uint64_t(packed.words().size()));
    raw(packed.words().data(), packed.words().size() * sizeof(std::uint64_t));
  }
  void raw(const void* data, std::size_t size) {
    const std::string_view bytes(static_cast<const char*>(data), size);
    if (waiting_.size() + size > at_a_time) flush();
    if (size > at_a_time) return pass_on(bytes);
    waiting_ += bytes;
  }
  WrittenBytes finish() {
    flush();
    number(written_.checksum);
    flush();
    return written_;
  }

 private:
  static constexpr std::size_t at_a_time = std::size_t(1) << 20;

  void flush() {
    pass_on(waiting_);
    waiting_.clear();
  }
  void pass_on(std::string_view bytes) {
    written_.count += bytes.size();
    written_.checksum = crc32c(bytes, written_.checksum);
    sink_(bytes);
  }

  const ByteSink& sink_;
  std::string waiting_;
  WrittenBytes written_;
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
  template <class T>
  std::vector<T> numbers() {
    const std::size_t size = count(sizeof(T));
    std::vector<T> values(size);
    const char* from = take(size * sizeof(T));
    if (size > 0) std::memcpy(values.data(), from, size * sizeof(T));
    return values;
  }
  PackedValues values() {
    const auto size = number<std::uint64_t>();
    auto packed = PackedValues::from_words(numbers<std::uint64_t>(), size);
    if (!packed || packed->size() != size) throw Error(ExitCode::bad_checkpoint, "packed values are inconsistent");
    return *std::move(packed);
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
  out.values(field.values);
}

FieldRecord read_field(Reader& in, std::uint32_t format) {
  FieldRecord field;
  field.name = in.text();
  for (int& i : field.lower) i = in.number<std::int32_t>();
  for (int& i : field.upper) i = in.number<std::int32_t>();
  field.values = format == 1 ? PackedValues(in.numbers<double>()) : in.values();
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

CheckpointData read_data(Reader& in, std::uint32_t format) {
  CheckpointData data;
  for (std::size_t left = in.count(1); left > 0; --left) {
    const std::string name = in.text();
    data.scalars[name] = in.number<double>();
  }
  for (std::size_t left = in.count(1); left > 0; --left) {
    const std::string name = in.text();
    data.texts[name] = in.text();
  }
  for (std::size_t left = in.count(1); left > 0; --left) data.fields.push_back(read_field(in, format));
  return data;
}

FixedHeader header_of(const std::string& bytes) {
  FixedHeader header{};
  std::memcpy(&header, bytes.data(), sizeof header);
  return header;
}

}  // namespace

WrittenBytes write_checkpoint_file(const CheckpointHeader& header, const CheckpointData& data, const ByteSink& sink) {
  FixedHeader fixed{{}, endianness_tag, checkpoint_format_version, precision, 0};
  std::memcpy(fixed.magic, magic, sizeof magic);
  Writer out(sink);
  out.raw(&fixed, sizeof fixed);
  out.number(std::int32_t(header.dimension));
  out.number(std::int32_t(header.rank));
  out.number(std::int32_t(header.ranks));
  out.number(header.step);
  out.text(header.scene_hash);
  out.text(header.creator);
  write_data(out, data);
  return out.finish();
}

std::string unknown_format(std::uint32_t version) {
  if (version >= oldest_checkpoint_format && version <= checkpoint_format_version) return {};
  return fmt::format("it has checkpoint format {} and this program reads format {}", version,
                     checkpoint_format_version);
}

CheckpointDefect examine_checkpoint_file(const std::string& bytes) {
  if (bytes.size() < sizeof(FixedHeader) + 4) return CheckpointDefect::damaged("it is too short");
  if (std::memcmp(bytes.data(), magic, sizeof magic) != 0)
    return CheckpointDefect::damaged("it does not begin like a checkpoint of Seiche");
  const std::string_view covered(bytes.data(), bytes.size() - 4);
  unsigned char stored[4];
  std::memcpy(stored, bytes.data() + covered.size(), 4);
  const std::uint32_t sum = crc32c(covered);
  const std::uint32_t little = stored[0] | stored[1] << 8 | stored[2] << 16 | std::uint32_t(stored[3]) << 24;
  const std::uint32_t big = stored[3] | stored[2] << 8 | stored[1] << 16 | std::uint32_t(stored[0]) << 24;
  if (sum != little && sum != big) return CheckpointDefect::damaged("its checksum does not match its contents");
  const FixedHeader header = header_of(bytes);
  if (header.endianness == __builtin_bswap32(endianness_tag)) {
    return CheckpointDefect::foreign("it is big-endian and this machine is little-endian");
  }
  if (std::string text = unknown_format(header.version); !text.empty()) return CheckpointDefect::foreign(text);
  if (header.endianness != endianness_tag)
    return CheckpointDefect::foreign("its byte order is not this machine's (little-endian)");
  if (header.precision != precision) {
    return CheckpointDefect::foreign(
        fmt::format("its numbers have {} bytes and this program's have {}", header.precision, precision));
  }
  return {};
}

CheckpointFile decode_checkpoint_file(const std::string& bytes) {
  const CheckpointDefect defect = examine_checkpoint_file(bytes);
  if (defect.kind != CheckpointDefect::Kind::none) throw Error(ExitCode::bad_checkpoint, defect.text);
  Reader in(std::string_view(bytes).substr(sizeof(FixedHeader), bytes.size() - sizeof(FixedHeader) - 4));
  CheckpointFile file;
  CheckpointHeader& header = file.header;
  header.dimension = in.number<std::int32_t>();
  header.rank = in.number<std::int32_t>();
  header.ranks = in.number<std::int32_t>();
  header.step = in.number<std::int64_t>();
  header.scene_hash = in.text();
  header.creator = in.text();
  file.data = read_data(in, header_of(bytes).version);
  if (!in.at_end()) throw Error(ExitCode::bad_checkpoint, "data are left over at its end");
  return file;
}

}  // namespace seiche
