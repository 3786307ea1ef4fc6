#pragma once
// Limit on the number of threads of this process's loops.
#include <memory>

namespace seiche {

// Applies during the object's lifetime. Results do not depend on it.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);  // at least 1
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seiche
