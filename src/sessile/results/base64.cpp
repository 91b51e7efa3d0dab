#include <array>

#include "sessile/core/error.h"
#include "sessile/results/frame_files.h"

namespace sessile {
namespace {

constexpr std::uint8_t no_digit = 255;

constexpr std::array<std::uint8_t, 256> values_of_digits() {
  std::array<std::uint8_t, 256> values{};
  values.fill(no_digit);
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < digits.size(); ++i) {
    values[static_cast<unsigned char>(digits[i])] = static_cast<std::uint8_t>(i);
  }
  return values;
}

constexpr std::array<std::uint8_t, 256> digit_values = values_of_digits();

}  // namespace

std::string base64_bytes(std::string_view text) {
  if (text.size() % 4 != 0) throw FileError("its base64 data is cut short");
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  std::string bytes(text.size() / 4 * 3, '\0');
  std::size_t to = 0;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool padded = i + k >= text.size() - padding;
      const std::uint8_t value = padded ? std::uint8_t{0} : digit_values[static_cast<unsigned char>(text[i + k])];
      if (value == no_digit) throw FileError("its base64 data holds a character that is none of base64");
      group = group << 6 | value;
    }
    for (const unsigned shift : {16U, 8U, 0U}) bytes[to++] = static_cast<char>(group >> shift & 255U);
  }
  bytes.resize(bytes.size() - padding);
  return bytes;
}

}  // namespace sessile
