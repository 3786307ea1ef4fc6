#include "base/agree.h"

#include <fmt/format.h>

#include <new>

#include "base/error.h"

namespace seiche {
namespace {

// "" for success, else the exit code's digits, a space and the message.
std::string outcome_of(const std::string& doing, const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (const Error& error) {
    return fmt::format("{} {}", int(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return fmt::format("{} out of memory while {}", int(ExitCode::machine), doing);
  } catch (const std::exception& error) {
    return fmt::format("{} bug: {} (while {})", int(ExitCode::bug), error.what(), doing);
  }
}

}  // namespace

void agree(const Communicator& ranks, const std::string& doing, const std::function<void()>& work) {
  const std::string mine = outcome_of(doing, work);
  if (!ranks.any(!mine.empty())) return;
  const std::vector<std::string> outcomes = ranks.all_gather(mine);
  for (std::size_t rank = 0; rank < outcomes.size(); ++rank) {
    if (outcomes[rank].empty()) continue;
    const std::size_t space = outcomes[rank].find(' ');
    const std::string who = rank == 0 ? "" : fmt::format("rank {}: ", rank);
    throw Error(ExitCode(std::stoi(outcomes[rank])), who + outcomes[rank].substr(space + 1));
  }
}

void agree_on_root(const Communicator& ranks, const std::string& doing, const std::function<void()>& work) {
  agree(ranks, doing, [&] {
    if (ranks.is_root()) work();
  });
}

}  // namespace seiche
