#include "sessile/particles/particles.h"

#include "sessile/core/parallel.h"

namespace sessile {

void Particles::resize(std::size_t n) {
  for_each_field([n](auto& array) { array.resize(n); });
}

std::size_t Particles::bytes() const {
  std::size_t total = bytes_of(std::get<0>(reorder_scratch_)) + bytes_of(std::get<1>(reorder_scratch_));
  for_each_field([&](const auto& array) { total += bytes_of(array); });
  return total;
}

void Particles::add(const Vec3r& x, const Vec3r& v, Real m, std::int64_t number) {
  position.push_back(x);
  velocity.push_back(v);
  mass.push_back(m);
  pressure.push_back(0);
  mean_pressure.push_back(0);
  divergence_pressure.push_back(0);
  id.push_back(number);
}

void Particles::reorder(std::span<const std::int32_t> order) {
  for_each_field([&]<class T>(Array<T>& array) {
    auto& sorted = std::get<Array<T>>(reorder_scratch_);
    sorted.resize(order.size());
    for_each_block(order.size(), [&](std::ptrdiff_t, std::ptrdiff_t begin, std::ptrdiff_t end) {
      for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
        sorted[k] = array[static_cast<std::size_t>(order[k])];
      }
    });
    array.swap(sorted);
  });
}

}  // namespace sessile
