#pragma once

#include <sys/mman.h>

#include <cstddef>

namespace sessile::test {

/// Room for n numbers, all of them 0, of which only those that are touched take memory: arrays at the bound of what can
/// be numbered. Empty where the system does not give as much address space.
template <class T>
class Sparse {
 public:
  explicit Sparse(std::size_t n) : bytes_(n * sizeof(T) + 64) {
    void* const place =
        mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (place != MAP_FAILED) data_ = static_cast<T*>(place);
  }
  ~Sparse() {
    if (data_ != nullptr) munmap(data_, bytes_);
  }
  Sparse(const Sparse&) = delete;
  Sparse& operator=(const Sparse&) = delete;

  explicit operator bool() const { return data_ != nullptr; }
  T* data() const { return data_; }
  T& operator[](std::size_t k) const { return data_[k]; }

 private:
  std::size_t bytes_;
  T* data_ = nullptr;
};

}  // namespace sessile::test
