#pragma once
// How many threads the loops of this process may use.
#include <memory>

namespace seiche {

// Holds for the life of the object; results do not depend on it.
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
