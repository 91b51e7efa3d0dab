#include "sessile/particles/particles.h"

#include <cstring>

#include "sessile/core/parallel.h"

namespace sessile {

void Particles::resize(std::size_t n) {
  for_each_field([n](auto& array) { array.resize(n); });
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
    reorder_scratch_.resize(order.size() * sizeof(T));
    T* sorted = reinterpret_cast<T*>(reorder_scratch_.data());
    for_each(order.size(),
             [&](int k) { sorted[k] = array[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])]; });
    array.resize(order.size());
    for_each(order.size(), [&](int k) { array[static_cast<std::size_t>(k)] = sorted[k]; });
  });
}

}  // namespace sessile
