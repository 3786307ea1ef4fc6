#include "run/watchdog.h"

#include <algorithm>

namespace seiche {

Watchdog::Watchdog(std::chrono::duration<double> limit, std::function<void(const std::string&)> expired)
    : limit_(limit), expired_(std::move(expired)), thread_([this] { watch(); }) {}

Watchdog::~Watchdog() {
  {
    const std::lock_guard guard(mutex_);
    end_ = true;
  }
  ended_.notify_all();
  thread_.join();
}

void Watchdog::beat(const std::string& phase) {
  const std::lock_guard guard(mutex_);
  phase_ = phase;
  idle_ = std::chrono::duration<double>::zero();
}

std::string Watchdog::phase() const {
  const std::lock_guard guard(mutex_);
  return phase_;
}

void Watchdog::watch() {
  // Idle time is summed over short naps, each counted at most twice its length. So the limit is not used up while the
  // process itself is suspended (Ctrl-Z, a closed laptop).
  const std::chrono::duration<double> nap = limit_ / 20;
  std::unique_lock guard(mutex_);
  while (!end_) {
    const auto before = std::chrono::steady_clock::now();
    ended_.wait_for(guard, nap);
    idle_ += std::min<std::chrono::duration<double>>(std::chrono::steady_clock::now() - before, 2 * nap);
    if (end_ || idle_ < limit_) continue;
    const std::string phase = phase_;
    guard.unlock();
    expired_(phase);
    return;
  }
}

}  // namespace seiche
