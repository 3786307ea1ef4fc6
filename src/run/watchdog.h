#pragma once
// Notices when a rank makes no progress any more (a hang, a stopped process, a dead peer).
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace seiche {

class Watchdog {
 public:
  // `expired` is called once, on the watchdog's thread, when no beat came for `limit`, with the phase of the last beat.
  Watchdog(std::chrono::duration<double> limit, std::function<void(const std::string& phase)> expired);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  // This rank has come to the named phase.
  void beat(const std::string& phase);
  std::string phase() const;

 private:
  void watch();

  std::chrono::duration<double> limit_;
  std::function<void(const std::string&)> expired_;
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  bool end_ = false;
  std::string phase_ = "start";
  std::chrono::duration<double> idle_{0};
  std::thread thread_;
};

}  // namespace seiche
