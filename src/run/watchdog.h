#pragma once
// Detects a rank without progress (a hang, a stopped process, a dead peer).
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace seiche {

class Watchdog {
 public:
  // Calls `expired` once, on the watchdog's thread, if no beat() came for `limit`, with the phase of the last one.
  Watchdog(std::chrono::duration<double> limit, std::function<void(const std::string& phase)> expired);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  // Heartbeat: this rank has reached the named phase.
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
