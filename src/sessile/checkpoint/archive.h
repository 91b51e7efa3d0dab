#pragma once

#include <zstd.h>

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sessile/checkpoint/state_fields.h"
#include "sessile/core/array.h"
#include "sessile/core/error.h"

namespace sessile {

static_assert(std::endian::native == std::endian::little, "checkpoints hold numbers as this machine does");

/// Compresses what it is given, piece by piece.
class StateWriter {
 public:
  StateWriter();

  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }

  /// The zstd frame; nothing can be added afterwards.
  std::string finish();
  std::uint64_t raw_bytes() const { return raw_bytes_; }

 private:
  template <class T>
  void put(const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      put(static_cast<std::uint8_t>(value));
    } else if constexpr (std::is_arithmetic_v<T>) {
      add(&value, sizeof value);
    } else {
      state_fields(*this, value);
    }
  }
  void put(const std::string& text) { put(std::string_view(text)); }
  void put(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    add(text.data(), text.size());
  }
  template <class T, class A>
  void put(const std::vector<T, A>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    if constexpr (std::is_arithmetic_v<T>) {
      add(values.data(), values.size() * sizeof(T));
    } else {
      for (const T& each : values) put(each);
    }
  }
  void add(const void* data, std::size_t size);
  void compress(ZSTD_inBuffer in, ZSTD_EndDirective end);

  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context_;
  std::string compressed_;
  std::uint64_t raw_bytes_ = 0;
};

/// Reads what a StateWriter was given, in the same order. Throws Error where the bytes end too early, or tell of more
/// than there is.
class StateReader {
 public:
  explicit StateReader(std::string_view bytes) : rest_(bytes) {}

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }

  bool at_end() const { return rest_.empty(); }

 private:
  template <class T>
  void get(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = number<std::uint8_t>() != 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
      value = number<T>();
    } else {
      state_fields(*this, value);
    }
  }
  void get(std::string& text) { text = take(number<std::uint64_t>(), 1); }
  template <class T, class A>
  void get(std::vector<T, A>& values) {
    const auto count = number<std::uint64_t>();
    if constexpr (std::is_arithmetic_v<T>) {
      const std::string_view bytes = take(count, sizeof(T));
      values.resize(bytes.size() / sizeof(T));
      if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    } else {
      for (std::uint64_t k = 0; k < count; ++k) get(values.emplace_back());  // each takes bytes: it ends
    }
  }
  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(1, sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view take(std::uint64_t count, std::size_t size) {
    if (count > rest_.size() / size) throw Error("ends too early");
    const std::string_view bytes = rest_.substr(0, static_cast<std::size_t>(count) * size);
    rest_.remove_prefix(bytes.size());
    return bytes;
  }

  std::string_view rest_;
};

}  // namespace sessile
