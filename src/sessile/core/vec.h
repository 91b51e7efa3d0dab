#pragma once

#include <cmath>
#include <type_traits>

#include "sessile/core/real.h"

namespace sessile {

/// Three components of one quantity. T is a number, or a pack of lanes inside a kernel.
template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  constexpr Vec3& operator+=(const Vec3& o) {
    x += o.x;
    y += o.y;
    z += o.z;
    return *this;
  }
  constexpr Vec3& operator-=(const Vec3& o) {
    x -= o.x;
    y -= o.y;
    z -= o.z;
    return *this;
  }
  friend constexpr Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
  friend constexpr Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
  friend constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(const T& s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend constexpr Vec3 operator*(const Vec3& a, const T& s) { return s * a; }
  friend constexpr bool operator==(const Vec3& a, const Vec3& b) requires std::is_arithmetic_v<T> {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
};

using Vec3r = Vec3<Real>;
using Vec3d = Vec3<double>;

template <class T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
constexpr T squared_length(const Vec3<T>& a) {
  return dot(a, a);
}

template <class T>
T length(const Vec3<T>& a) {
  using std::sqrt;
  return sqrt(squared_length(a));
}

/// The same vector in another number type.
template <class To, class From>
constexpr Vec3<To> vec_cast(const Vec3<From>& a) {
  return {static_cast<To>(a.x), static_cast<To>(a.y), static_cast<To>(a.z)};
}

}  // namespace sessile
