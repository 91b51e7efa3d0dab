#include "sessile/measure/structure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "sessile/core/first_error.h"

namespace sessile {
namespace {

constexpr int loose_neighbors = 4;
constexpr double link_distance = 1.5;  // over dx
// Much larger than the blocks of other loops: what links two blocks is joined by one thread.
constexpr std::size_t particles_per_block = 4096;

/// Sets of particles, each known by its smallest index: the same sets in whatever order they are joined.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// Joins i's set with j's, where `set` is the root of i's; returns the root of both.
  std::int32_t join(std::int32_t set, std::int32_t j) {
    if (parent_[index(j)] == set) return set;  // the common case, worth a branch of its own
    const std::int32_t other = root(j);
    parent_[index(std::max(set, other))] = std::min(set, other);
    return std::min(set, other);
  }

  std::int32_t root(std::int32_t i) {
    while (parent_[index(i)] != i) {
      parent_[index(i)] = parent_[index(parent_[index(i)])];  // halves the way of the next search
      i = parent_[index(i)];
    }
    return i;
  }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  std::vector<std::int32_t> parent_;
};

/// What one block of particles adds up to.
struct Part {
  std::int64_t loose = 0, first_layer = 0;
  std::vector<std::pair<std::int32_t, std::int32_t>> links;  // to particles of earlier blocks
};

/// Fills `distances` with the squares |x_i - x_j|^2 [m^2] for j in `row`; returns the least, or infinity.
Real squared_distances(const Cloud& cloud, std::size_t i, const Array3& others, const Neighbors& row,
                       Array<Real>& distances) {
  if (distances.size() < row.size()) distances.resize(row.size());
  const Vec3r xi = cloud.position[i];
  const Space space = cloud.space;
  const Real *x = others.x.data(), *y = others.y.data(), *z = others.z.data();
  Real* result = distances.data();
  Real least = std::numeric_limits<Real>::infinity();
  const std::size_t count = row.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t j = row[k];
    result[k] = squared_length(space.displacement(xi, {x[j], y[j], z[j]}));
    least = std::min(least, result[k]);
  }
  return least;
}

/// Keeps those of `row` that come before `self` and are nearer than the link distance; returns how many.
std::size_t keep_linked(const Neighbors& row, const Array<Real>& distances, Real link2, std::int32_t self,
                        Array<std::int32_t>& links) {
  if (links.size() < row.size()) links.resize(row.size());
  std::size_t kept = 0;
  for (std::size_t k = 0; k < row.size(); ++k) {
    links[kept] = row[k];
    const bool before = row[k] < self, near = distances[k] < link2;
    kept += before && near;  // both are known: no branch on a coin toss
  }
  return kept;
}

/// Fills in the percentiles of the nearest distances, given as squares [m^2]; reorders them.
void describe_nearest(Array<Real>& squares, double spacing, Structure& result) {
  const auto place = [&](double share) {
    return squares.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(squares.size() - 1));
  };
  const auto middle = place(0.5), low = place(0.05);
  std::nth_element(squares.begin(), middle, squares.end());
  std::nth_element(squares.begin(), low, middle);  // the median stands, and what is lower lies before it
  const auto least = std::min_element(squares.begin(), low + 1);
  result.nearest_min = std::sqrt(static_cast<double>(*least)) / spacing;
  result.nearest_p5 = std::sqrt(static_cast<double>(*low)) / spacing;
  result.nearest_median = std::sqrt(static_cast<double>(*middle)) / spacing;
}

void count_pieces(Sets& sets, const std::vector<unsigned char>& touches, Structure& result) {
  const std::size_t n = touches.size();
  std::vector<std::int32_t> sizes(n, 0);
  std::vector<unsigned char> clings(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const auto root = static_cast<std::size_t>(sets.root(static_cast<std::int32_t>(i)));
    ++sizes[root];
    clings[root] |= touches[i];
  }
  for (std::size_t i = 0; i < n; ++i) result.held += clings[i] != 0 ? sizes[i] : 0;
  result.pieces = std::count_if(sizes.begin(), sizes.end(), [](std::int32_t size) { return size > 0; });
  result.largest_share = static_cast<double>(*std::max_element(sizes.begin(), sizes.end())) / static_cast<double>(n);
}

}  // namespace

Structure structure(const Cloud& cloud) {
  Structure result;
  const std::size_t n = cloud.position.size();
  if (n == 0) return result;

  Sets sets(n);
  Array<Real> nearest(n);                    // squared distance [m^2]
  std::vector<unsigned char> touches(n, 0);  // whether it is of the first layer
  const auto link2 = static_cast<Real>(std::pow(link_distance * cloud.spacing, 2));
  const auto support2 = static_cast<Real>(std::pow(cloud.support_radius, 2));

  std::vector<Part> parts((n + particles_per_block - 1) / particles_per_block);
  FirstError error;
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t block = 0; block < parts.size(); ++block) {
    error.guard([&] {
      const std::size_t begin = block * particles_per_block, end = std::min(n, begin + particles_per_block);
      Part& part = parts[block];
      const auto first = static_cast<std::int32_t>(begin);
      Array<Real> distances;
      Array<std::int32_t> links;
      for (std::size_t i = begin; i < end; ++i) {
        const auto neighbors = cloud.fluid_neighbors[i], walls = cloud.wall_neighbors[i];
        nearest[i] = std::min(support2, squared_distances(cloud, i, cloud.position, neighbors, distances));

        // A block joins only its own particles, so that blocks do not meet; links between blocks wait until all are
        // done.
        const auto self = static_cast<std::int32_t>(i);
        const std::size_t linked = keep_linked(neighbors, distances, link2, self, links);
        std::int32_t set = self;
        for (std::size_t k = 0; k < linked; ++k) {
          if (links[k] >= first) {
            set = sets.join(set, links[k]);
          } else {
            part.links.emplace_back(self, links[k]);
          }
        }

        part.loose += neighbors.size() <= loose_neighbors && walls.empty();
        touches[i] = squared_distances(cloud, i, cloud.wall_position, walls, distances) < link2;
        part.first_layer += touches[i];
      }
    });
  }
  error.rethrow();
  for (const Part& part : parts) {
    result.loose += part.loose;
    result.first_layer += part.first_layer;
    for (const auto& [a, b] : part.links) sets.join(sets.root(a), b);
  }

  result.wetted_area = static_cast<double>(result.first_layer) * cloud.spacing * cloud.spacing;
  count_pieces(sets, touches, result);
  describe_nearest(nearest, cloud.spacing, result);
  return result;
}

}  // namespace sessile
