#pragma once

#include <atomic>
#include <exception>

namespace sessile {

/// Carries the first exception out of a loop on several threads: one that left a parallel region would end the program.
class FirstError {
 public:
  /// Calls work(), unless some has failed already: then the loop's result is of no use.
  template <class Work>
  void guard(const Work& work) noexcept {
    if (failed_.load(std::memory_order_relaxed)) return;
    try {
      work();
    } catch (...) {
      if (!failed_.exchange(true)) error_ = std::current_exception();
    }
  }

  /// After the loop: throws what went wrong in it, if anything did.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::atomic<bool> failed_ = false;
  std::exception_ptr error_;  // written by the thread that failed first, read after all are done
};

}  // namespace sessile
