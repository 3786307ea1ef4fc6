#include "validate/run/obtain.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "base/agree.h"
#include "base/scene.h"
#include "base/version.h"
#include "files/checked_file.h"
#include "files/json.h"
#include "validate/record/machine.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

constexpr auto patience = std::chrono::seconds(3);

// Passes only warnings and the live line of a run to the terminal, with the run's name as prefix.
Console console_of(const Planned& run, const Console& outer) {
  const std::string prefix = fmt::format("{} {}: ", run.one->name, run.resolution->name);
  Console inner;
  inner.line = [](const std::string&) {};
  inner.warning = [&outer, prefix](const std::string& text) { outer.warning(prefix + text); };
  if (outer.live) inner.live = [&outer, prefix](const std::string& text) { outer.live(prefix + text); };
  return inner;
}

// Measures on rank 0; all ranks get the figures.
Measurement measure_on_root(const MeasureSpec& spec, const fs::path& run, const Communicator& ranks) {
  Measurement result;
  agree_on_root(ranks, "measuring", [&] { result = measure(spec, RunPaths{run}); });
  const std::string text =
      ranks.broadcast(fmt::format("{:a} {:a} {} {:a}", result.value, result.error, int(result.reference.has_value()),
                                  result.reference.value_or(0)));
  const char* at = text.c_str();
  char* end = nullptr;
  const auto next = [&] {
    const double value = std::strtod(at, &end);
    at = end;
    return value;
  };
  result.value = next();
  result.error = next();
  const bool has_reference = next() != 0;
  const double reference = next();
  result.reference = has_reference ? std::optional(reference) : std::nullopt;
  return result;
}

// Source of a run: an earlier one, the rest of an interrupted one, a new one, or none.
enum class Source { earlier, rest, anew, none };

struct Found {
  ExitCode code = ExitCode::done;
  Source source = Source::none;
  fs::path run;
};

fs::path place_of(const Planned& run, const Validation& v) {
  return v.options.out / run.one->name / run.resolution->name;
}

// The cache reads the folders again before a run, since another validation may have made it.
std::optional<fs::path> earlier_run(const Planned& run, Validation& v, const std::string& identity) {
  const auto known = v.cache.find(*run.scene, identity);
  if (known || v.options.making == Making::report) return known;
  v.cache.look();
  return v.cache.find(*run.scene, identity);
}

Source source_of(const Planned& run, Validation& v, const std::string& identity, fs::path& place) {
  if (const auto earlier = earlier_run(run, v, identity)) {
    place = *earlier;
    return Source::earlier;
  }
  if (v.options.making == Making::report) return Source::none;
  const auto begun = v.cache.find_begun(*run.scene, identity);
  if (begun) place = *begun;
  return begun ? Source::rest : Source::anew;
}

// Rank 0 searches; all ranks get the answer. `identity` is set on rank 0.
Found look_for_run(const Planned& run, Validation& v, std::string& identity) {
  Found found;
  agree_on_root(v.around.ranks, "looking for earlier runs", [&] {
    identity = run_identity(*run.scene, v.around.ranks.size(), v.options.perturbation);
    found.run = place_of(run, v);
    found.source = source_of(run, v, identity, found.run);
  });
  const std::string text = v.around.ranks.broadcast(fmt::format("{}{}", int(found.source), found.run.string()));
  found.source = Source(text[0] - '0');
  found.run = text.substr(1);
  return found;
}

SessionOptions session_of(const ValidateOptions& options) {
  SessionOptions session;
  session.threads = options.threads;
  session.perturbation = options.perturbation;
  return session;
}

bool is_finished_on_root(const fs::path& run, const Communicator& ranks) {
  return ranks.broadcast(ranks.is_root() && is_finished(run) ? "1" : "0") == "1";
}

// Resumes an interrupted run. Empty if its checkpoints are lost, or if they are of its end but its summary is missing.
std::optional<ExitCode> run_rest(const fs::path& folder, const Validation& v, const Surroundings& around) {
  try {
    const ExitCode code = resume_command({folder, {}, {}, EditPolicy::refuse, session_of(v.options)}, around);
    if (code != ExitCode::done || is_finished_on_root(folder, around.ranks)) return code;
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_checkpoint) throw;
    around.console.warning(fmt::format("made anew, since its checkpoints cannot be used: {}", error.what()));
  }
  return std::nullopt;
}

ExitCode run_anew(const Planned& run, const fs::path& folder, const std::string& identity, Validation& v,
                  const Surroundings& around) {
  agree_on_root(v.around.ranks, "preparing the run", [&] { v.cache.begin(folder, *run.scene, identity); });
  RunOptions own;
  own.scene = scene_of(*run.one, *run.resolution);
  own.out = folder;
  own.overrides = run.resolution->overrides;
  own.existing = ExistingOutput::resume;  // RunCache::begin() has prepared the folder
  own.session = session_of(v.options);
  return run_command(own, around);
}

Found obtain_run(const Planned& run, Validation& v) {
  std::string identity;
  Found found = look_for_run(run, v, identity);
  if (found.source == Source::earlier || found.source == Source::none) return found;
  const Surroundings inner{v.around.ranks, v.around.emergency, console_of(run, v.around.console)};
  std::optional<ExitCode> code;
  if (found.source == Source::rest) code = run_rest(found.run, v, inner);
  if (!code) {
    found.run = place_of(run, v);
    code = run_anew(run, found.run, identity, v, inner);
  }
  found.code = *code;
  if (found.code == ExitCode::done)
    agree_on_root(v.around.ranks, "keeping the run", [&] { v.cache.keep(found.run, identity); });
  return found;
}

// Number in the summary.json of a finished run; empty if it is unreadable.
std::optional<double> number_in_summary(const fs::path& run, const char* key) {
  try {
    return json_number(read_whole_file(RunPaths{run}.summary()), key);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::string identity_of(const Planned& run) {
  return measured_identity(*run.scene, measure_of(*run.one, *run.resolution));
}

std::optional<RecordedRun> recorded_run(const Planned& run, const ValidationRecord& record) {
  const auto row = [&](const std::string& identity) {
    return record.find(run.one->name, run.resolution->name, identity);
  };
  if (const auto known = row(identity_of(run))) return known;
  for (const std::string& identity : older_identities(*run.scene, measure_of(*run.one, *run.resolution)))
    if (const auto known = row(identity)) return known;
  return std::nullopt;
}

// Origin of an existing run.
Origin origin_of(const fs::path& run, const Communicator& ranks) {
  const int threads = int(number_in_summary(run, "threads").value_or(0));
  return {build_digest(), date_of(RunPaths{run}.summary()), ranks.size(), threads, machine_of(run)};
}

// Earlier runs may have been damaged since.
Measurement measure_found(const Planned& run, const Found& found, const Communicator& ranks) {
  try {
    return measure_on_root(measure_of(*run.one, *run.resolution), found.run, ranks);
  } catch (const Error& error) {
    if (found.source != Source::earlier) throw;
    throw Error(error.code(), fmt::format("{} (of an earlier run; --fresh makes it anew)", error.what()));
  }
}

ExitCode run_and_measure(const Planned& run, Validation& v, CaseResult& result) {
  const Found found = obtain_run(run, v);
  result.run = found.run;
  result.cached = found.source == Source::earlier;
  if (found.source == Source::none) {
    const fs::path place = result.run;
    result = recorded_result(run, v.record);
    if (!result.recorded) result.run = place;
    return found.code;
  }
  if (found.code != ExitCode::done) return found.code;
  result.measured = measure_found(run, found, v.around.ranks);
  result.origin = origin_of(result.run, v.around.ranks);
  result.verdict = Verdict::missed;  // until it is judged
  return found.code;
}

// Like run_and_measure(), but a simulation that cannot continue, on all ranks together, is a result.
ExitCode attempt(const Planned& run, Validation& v, CaseResult& result) {
  try {
    return run_and_measure(run, v, result);
  } catch (const Error& error) {
    const bool together =
        error.code() == ExitCode::cannot_continue && v.around.emergency.meet(int(error.code()), patience).has_value();
    if (!together) throw;
    result.message = error.what();
    const int threads = int(number_in_summary(result.run, "threads").value_or(0));
    result.origin = {build_digest(), today(), v.around.ranks.size(), threads, describe_machine()};
    return ExitCode::done;
  }
}

}  // namespace

Validation start(const ValidateOptions& options, const Surroundings& around) {
  Validation v{options, around, RunCache(options.out, around.ranks.is_root() ? options.earlier : Earlier::ignore), {}};
  if (!options.record) return v;
  std::string text;
  agree_on_root(around.ranks, "reading the record", [&] { text = read_record(*options.record); });
  text = around.ranks.broadcast(text);
  agree(around.ranks, "reading the record", [&] { v.record.emplace(*options.record, text); });
  return v;
}

ExitCode obtain(const Planned& run, Validation& v, CaseResult& result) {
  result.cell_size = run.scene->domain.cell_size;
  result.run = place_of(run, v);
  const ExitCode code = attempt(run, v, result);
  if (!result.recorded && result.verdict != Verdict::absent)
    result.wall_seconds = number_in_summary(result.run, "wall_seconds").value_or(0);
  return code;
}

CaseResult recorded_result(const Planned& run, const std::optional<ValidationRecord>& record) {
  CaseResult result;
  result.cell_size = run.scene->domain.cell_size;
  result.verdict = Verdict::absent;
  if (!record) return result;
  const auto recorded = recorded_run(run, *record);
  if (!recorded) return result;
  const bool failed = !recorded->failure.empty();
  result.verdict = failed ? Verdict::failed : Verdict::missed;  // until it is judged
  result.recorded = true;
  result.measured = recorded->measured;
  result.origin = recorded->origin;
  result.wall_seconds = recorded->seconds;
  if (failed) result.message = fmt::format("on {}: {}", result.origin.date, recorded->failure);
  return result;
}

void put_on_record(const Planned& run, Validation& v, const CaseResult& result) {
  if (!v.record || result.recorded || result.verdict == Verdict::absent) return;
  const std::string failure = is_measured(result)      ? ""
                              : result.message.empty() ? std::string("no reason given")
                                                       : result.message;
  const std::string identity = identity_of(run);
  Origin origin = result.origin;
  const auto known = v.record->find(run.one->name, run.resolution->name, identity);
  if (origin.machine.empty() && known && known->origin.build == origin.build && known->origin.date == origin.date)
    origin.machine = known->origin.machine;  // same run
  std::string text;
  agree_on_root(v.around.ranks, "writing the record", [&] {
    text = put_on_file(
        *v.options.record,
        {run.one->name, run.resolution->name, identity, {origin, result.wall_seconds, result.measured, failure}});
  });
  text = v.around.ranks.broadcast(text);
  agree(v.around.ranks, "reading the record", [&] { v.record.emplace(*v.options.record, text); });
}

}  // namespace seiche
