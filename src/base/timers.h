#pragma once
// Wall time by phase of the step, for summary.json and the benchmarks.
#include <chrono>
#include <map>
#include <string>

namespace seiche {

class Timers {
 public:
  // Adds its lifetime (s) to a phase's total.
  class Scope {
   public:
    explicit Scope(double& total) : total_(total), start_(std::chrono::steady_clock::now()) {}
    ~Scope() { total_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    double& total_;
    std::chrono::steady_clock::time_point start_;
  };

  [[nodiscard]] Scope measure(const std::string& phase) { return Scope(seconds_[phase]); }
  const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  std::map<std::string, double> seconds_;
};

}  // namespace seiche
