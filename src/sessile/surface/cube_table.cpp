#include "sessile/surface/cube_table.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace sessile {
namespace {

constexpr int none = -1;
constexpr double impossible = std::numeric_limits<double>::infinity();

/// The corners of face 2 axis + side, counterclockwise from outside the cube.
std::array<int, 4> face_corners(int face) {
  const int axis = face / 2, side = face % 2, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
  const int start = side << axis;
  if (side == 1) return {start, start + u, start + u + v, start + v};
  return {start, start + v, start + u + v, start + u};
}

int edge_between(int a, int b) {
  for (int edge = 0; edge < edge_count; ++edge) {
    if (std::min(a, b) == edge_start(edge) && std::max(a, b) == edge_end(edge)) return edge;
  }
  return none;
}

bool on_face(int edge, int face) {
  const int axis = face / 2, side = face % 2;
  return edge / 4 != axis && (edge_start(edge) >> axis & 1) == side;
}

bool share_face(int a, int b) {
  for (int face = 0; face < 6; ++face) {
    if (on_face(a, face) && on_face(b, face)) return true;
  }
  return false;
}

/// Squared distance of the middles of two edges.
double distance2(int a, int b) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto middle = [axis](int edge) { return edge / 4 == axis ? 0.5 : edge_start(edge) >> axis & 1; };
    sum += (middle(a) - middle(b)) * (middle(a) - middle(b));
  }
  return sum;
}

/// Where the surface's outline goes on from each edge it crosses: seen from outside the cube, around a face, it leads
/// from the edge where the inside begins back to the edge where the inside ended last. So it cuts off the outside
/// corners of an ambiguous face one by one, and the inside ones stay joined.
std::array<int, edge_count> outline(unsigned inside) {
  std::array<int, edge_count> next;
  next.fill(none);
  for (int face = 0; face < 6; ++face) {
    const auto corners = face_corners(face);
    const auto corner = [&](int k) { return corners[static_cast<std::size_t>(k & 3)]; };
    const auto holds = [&](int k) { return (inside >> corner(k) & 1) != 0; };
    for (int k = 0; k < 4; ++k) {
      if (holds(k) || !holds(k + 1)) continue;  // the inside begins on the edge from k to k + 1
      int last = k;
      while (!holds(last - 1)) --last;
      next[static_cast<std::size_t>(edge_between(corner(k), corner(k + 1)))] =
          edge_between(corner(last - 1), corner(last));
    }
  }
  return next;
}

/// Cuts a polygon into triangles by the shortest diagonals of which none lies in a face.
class Triangulation {
 public:
  explicit Triangulation(const std::vector<int>& polygon) : polygon_(polygon), n_(polygon.size()) {
    cost_.assign(n_ * n_, 0);
    apex_.assign(n_ * n_, 0);
    for (std::size_t length = 2; length < n_; ++length) {
      for (std::size_t i = 0; i + length < n_; ++i) choose_apex(i, i + length);
    }
  }

  bool possible() const { return cost_[n_ - 1] < impossible; }
  void write(CubeCase& to) const { write(to, 0, n_ - 1); }

 private:
  double diagonal(std::size_t i, std::size_t j) const {
    if (j - i == 1 || (i == 0 && j == n_ - 1)) return 0;  // a side
    return share_face(polygon_[i], polygon_[j]) ? impossible : distance2(polygon_[i], polygon_[j]);
  }

  void choose_apex(std::size_t i, std::size_t j) {
    double best = impossible;
    for (std::size_t k = i + 1; k < j; ++k) {
      const double cost = cost_[i * n_ + k] + cost_[k * n_ + j] + diagonal(i, k) + diagonal(k, j);
      if (cost < best) best = cost, apex_[i * n_ + j] = k;
    }
    cost_[i * n_ + j] = best;
  }

  void write(CubeCase& to, std::size_t i, std::size_t j) const {
    if (j - i < 2) return;
    const std::size_t k = apex_[i * n_ + j];
    std::size_t at = 3 * static_cast<std::size_t>(to.triangles++);
    for (const std::size_t corner : {i, k, j}) to.edges.at(at++) = static_cast<std::uint8_t>(polygon_[corner]);
    write(to, i, k);
    write(to, k, j);
  }

  const std::vector<int>& polygon_;
  std::size_t n_;
  std::vector<double> cost_;       // of the polygon from i to j, at i n + j
  std::vector<std::size_t> apex_;  // of the triangle on its side from i to j
};

}  // namespace

CubeTable::CubeTable() {
  for (unsigned inside = 0; inside < cases_.size(); ++inside) {
    auto next = outline(inside);
    for (int start = 0; start < edge_count; ++start) {
      std::vector<int> polygon;
      for (int edge = start; next[static_cast<std::size_t>(edge)] != none;) {
        polygon.push_back(edge);
        edge = std::exchange(next[static_cast<std::size_t>(edge)], none);
      }
      if (polygon.empty()) continue;
      const Triangulation triangles(polygon);
      if (!triangles.possible()) throw std::logic_error("a cube's case cannot be cut into triangles off its faces");
      triangles.write(cases_[inside]);
    }
  }
}

}  // namespace sessile
