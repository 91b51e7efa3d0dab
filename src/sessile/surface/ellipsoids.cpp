#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "sessile/core/parallel.h"
#include "sessile/surface/blobs_of.h"

/// Yu and Turk's ellipsoids. Two things differ from the publication: centres move by how much more a particle is off
/// its neighbours' mean than these are on average, so that noise goes and the surface does not sink; and ellipsoids are
/// never longer than the round kernel, only flatter, so that no setting makes particles reach farther.
namespace sessile {
namespace {

struct Symmetric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  void add(double weight, const Vec3d& d) {
    xx += weight * d.x * d.x, xy += weight * d.x * d.y, xz += weight * d.x * d.z;
    yy += weight * d.y * d.y, yz += weight * d.y * d.z, zz += weight * d.z * d.z;
  }
};

struct Axes {
  std::array<double, 3> value;
  std::array<Vec3d, 3> direction;
};

/// Eigenvalues and eigenvectors, by Jacobi's rotations.
Axes axes_of(const Symmetric& m) {
  double a[3][3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  constexpr int sweeps = 6;  // each squares what is left off the diagonal
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
        const double c = 1 / std::hypot(t, 1.0), s = t * c;
        for (auto& row : a) {
          const double ap = row[p], aq = row[q];
          row[p] = c * ap - s * aq, row[q] = s * ap + c * aq;
        }
        for (int k = 0; k < 3; ++k) {
          const double ap = a[p][k], aq = a[q][k], vp = v[k][p], vq = v[k][q];
          a[p][k] = c * ap - s * aq, a[q][k] = s * ap + c * aq;
          v[k][p] = c * vp - s * vq, v[k][q] = s * vp + c * vq;
        }
      }
    }
  }
  return {{a[0][0], a[1][1], a[2][2]},
          {Vec3d{v[0][0], v[1][0], v[2][0]}, Vec3d{v[0][1], v[1][1], v[2][1]}, Vec3d{v[0][2], v[1][2], v[2][2]}}};
}

class Ellipsoids {
 public:
  Ellipsoids(const AnisotropicKernels& method, const Cloud& cloud) : method_(method), cloud_(cloud) {}

  Blobs make() {
    blobs_.centers.resize(cloud_.size());
    blobs_.blobs.resize(cloud_.size());
    offsets_.resize(cloud_.size());
    for_each(cloud_.size(), [&](int i) { offsets_[index(i)] = offset(index(i)); });
    for_each(cloud_.size(), [&](int i) { move(index(i)); });
    for_each(cloud_.size(), [&](int i) { shape(index(i)); });
    for_each(cloud_.size(), [&](int i) { weigh(index(i)); });
    return std::move(blobs_);
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  static Vec3d point(const Array3& of, std::size_t i) { return vec_cast<double>(of[i]); }

  /// 1 - (r/R)^3
  double weight(const Vec3d& d) const {
    const double q = length(d) / cloud_.search_radius;
    return q < 1 ? 1 - q * q * q : 0;
  }

  /// From a particle to the mean of those around it, itself among them.
  Vec3d offset(std::size_t i) const {
    const Vec3d at = point(cloud_.position, i);
    Vec3d sum;
    double total = 1;
    for (const std::int32_t j : cloud_.near[i]) {
      const Vec3d d = point(cloud_.position, index(j)) - at;
      total += weight(d);
      sum += weight(d) * d;
    }
    return 1 / total * sum;
  }

  void move(std::size_t i) {
    const Vec3d at = point(cloud_.position, i);
    Vec3d usual = offsets_[i];
    double total = 1;
    for (const std::int32_t j : cloud_.near[i]) {
      const double w = weight(point(cloud_.position, index(j)) - at);
      usual += w * offsets_[index(j)];
      total += w;
    }
    blobs_.centers.set(i, vec_cast<Real>(at + method_.evening * (offsets_[i] - 1 / total * usual)));
  }

  /// How long each axis is, of the round kernel's radius. Few neighbours say little: those near to none stay round.
  std::array<double, 3> lengths(const Axes& axes, double neighbours) const {
    const double greatest = std::max({axes.value[0], axes.value[1], axes.value[2]});
    constexpr double enough = 4;  // in weights: two rings of a strand, half a ring of a film
    const double trust = std::min(1.0, neighbours / enough);
    std::array<double, 3> length{1, 1, 1};
    for (std::size_t k = 0; k < 3 && greatest > 0; ++k) {
      const double fitted = std::sqrt(std::max(axes.value[k], 0.0) / greatest);
      length[k] = 1 + trust * (std::max(fitted, method_.flattest) - 1);
    }
    return length;
  }

  void shape(std::size_t i) {
    const Vec3d at = point(cloud_.position, i);
    const Vec3d mean = offsets_[i];
    Symmetric covariance;
    double total = 0;
    covariance.add(1, mean);
    for (const std::int32_t j : cloud_.near[i]) {
      const Vec3d d = point(cloud_.position, index(j)) - at;
      const double w = weight(d);
      covariance.add(w, d - mean);
      total += w;
    }
    const Axes axes = axes_of(covariance);
    const auto length = lengths(axes, total);
    Symmetric form, box;  // A = sum n n / l^2; the box's half edges are the roots of the diagonal of sum n n l^2
    for (std::size_t k = 0; k < 3; ++k) {
      const double l = length[k] * cloud_.search_radius;
      form.add(1 / (l * l), axes.direction[k]);
      box.add(l * l, axes.direction[k]);
    }
    Blob& blob = blobs_.blobs[i];
    const auto number = [](double x) { return static_cast<float>(x); };
    blob.xx = number(form.xx), blob.xy = number(form.xy), blob.xz = number(form.xz);
    blob.yy = number(form.yy), blob.yz = number(form.yz), blob.zz = number(form.zz);
    blob.reach = {number(std::sqrt(box.xx)), number(std::sqrt(box.yy)), number(std::sqrt(box.zz))};
  }

  /// So that the density is about 1 at each particle, however close its neighbours are: films do not tear.
  void weigh(std::size_t i) {
    const Vec3d at = point(blobs_.centers, i);
    Blob& blob = blobs_.blobs[i];
    double density = 1;
    for (const std::int32_t j : cloud_.near[i]) {
      const Vec3d d = point(blobs_.centers, index(j)) - at;
      const double q2 = blob.xx * d.x * d.x + blob.yy * d.y * d.y + blob.zz * d.z * d.z +
                        2 * (blob.xy * d.x * d.y + blob.xz * d.x * d.z + blob.yz * d.y * d.z);
      density += blob_kernel(std::sqrt(std::max(q2, 0.0)));
    }
    blob.weight = static_cast<float>(1 / density);
  }

  const AnisotropicKernels& method_;
  const Cloud& cloud_;
  std::vector<Vec3d> offsets_;
  Blobs blobs_;
};

}  // namespace

Blobs blobs_of(const AnisotropicKernels& method, const Cloud& cloud) { return Ellipsoids(method, cloud).make(); }

}  // namespace sessile
