#pragma once

#include <variant>
#include <vector>

namespace sessile::test {

/// Every model of a variant, with its defaults.
template <class... T>
std::vector<std::variant<T...>> one_of_each(const std::variant<T...>&) {
  return {T{}...};
}

}  // namespace sessile::test
