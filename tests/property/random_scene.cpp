#include "property/random_scene.h"

#include <algorithm>
#include <optional>
#include <variant>

#include "property/dice.h"
#include "sessile/core/units.h"
#include "sessile/scene/sampling.h"

namespace sessile::test {
namespace {

/// The `index`-th member of a variant, with its defaults.
template <class... T>
std::variant<T...> member(const std::variant<T...>&, int index) {
  const std::variant<T...> all[]{T{}...};
  return all[index];
}

class SceneMaker {
 public:
  explicit SceneMaker(unsigned seed) : dice_(seed), large_(seed % 3 == 1) {}

  Scene make() {
    scale();
    solver();
    forces();
    bodies();
    surroundings();
    if (dice_.chance(0.35)) emitters();
    time();
    return scene_;
  }

 private:
  void scale() {
    dx_ = dice_.magnitude(1e-5, 10);
    scene_.spacing = dx_;
    scene_.support = dice_.chance(0.7) ? 2 : dice_.uniform(1.7, 2.6);
    scene_.fluid.rest_density = dice_.magnitude(10, 2e4);
    const double g = dice_.chance(0.2) ? 0 : dice_.magnitude(0.01, 1000);
    scene_.gravity = dice_.chance(0.8) ? Vec3d{0, 0, -g} : g * dice_.direction();
    speed_ = std::max(std::sqrt(8 * g * dx_), dice_.magnitude(1e-3, 10));
    if (dice_.chance(0.8))
      scene_.fluid.viscosity = scene_.fluid.rest_density * dx_ * speed_ * dice_.magnitude(1e-4, 10);
  }

  void solver() {
    scene_.pressure = member(Pressure{}, dice_.below(static_cast<int>(std::variant_size_v<Pressure>)));
    if (auto* iisph = std::get_if<Iisph>(&scene_.pressure)) {
      iisph->error = dice_.magnitude(1e-5, 1e-2);
      if (dice_.chance(0.5)) iisph->iteration = Iteration::jacobi;
      if (dice_.chance(0.5)) iisph->prediction = Prediction::positions;
      if (dice_.chance(0.2)) iisph->max_iterations = 5;
    }
    if (auto* wcsph = std::get_if<Wcsph>(&scene_.pressure)) {
      if (dice_.chance(0.5)) wcsph->sound_speed = speed_ * dice_.uniform(10, 30);
    }
  }

  /// Strengths are such that the tension is that of a Weber number rho0 dx v^2 / sigma from 0.03 to 1000.
  void forces() {
    const Units units{dx_, scene_.support_radius(), scene_.fluid.rest_density};
    for (int count = dice_.below(3); count > 0; --count) {
      Force force = member(Force{}, dice_.below(static_cast<int>(std::variant_size_v<Force>)));
      const double sigma = scene_.fluid.rest_density * dx_ * speed_ * speed_ * dice_.magnitude(1e-3, 30);
      const double acceleration = sigma / (scene_.fluid.rest_density * dx_ * dx_);
      const double adhesion = dice_.chance(0.3) ? 0 : dice_.magnitude(0.1, 50);
      std::visit(
          [&](auto& model) {
            constexpr bool has_strength = requires { model.strength; };
            if constexpr (has_strength) {
              model.strength = 1;
              model.strength = sigma / model.tension(units);
            } else {
              model.area_minimisation = dice_.chance(0.5) ? 0 : acceleration;
              model.cohesion = 1;
              model.cohesion = sigma / model.tension(units);
            }
            if constexpr (requires { model.adhesion; }) {
              if constexpr (has_strength) {
                model.adhesion = adhesion * model.strength;
              } else {
                model.adhesion = adhesion * model.cohesion;
              }
            }
            if constexpr (requires { model.air_pressure; }) {
              if (dice_.chance(0.5)) model.air_pressure = sigma / dx_;
            }
          },
          force);
      scene_.forces.push_back(force);
    }
  }

  /// One or two bodies, one above the other, in a ball of radius reach_ about centre_.
  void bodies() {
    centre_ = dice_.chance(0.5) ? Vec3d{} : dx_ * dice_.magnitude(1, 1000) * dice_.direction();
    const int count = dice_.from(1, 2);
    double top = 0;
    for (int k = 0; k < count; ++k) {
      Body body;
      double radius = dx_ * dice_.magnitude(2, count == 1 ? 8 : 6);
      body.shape = shape(radius);
      if (large_) radius *= enlarge(body, dice_.magnitude(1200, 3000) / count);
      if (dice_.chance(0.5)) body.placement.axis = dice_.direction();
      if (dice_.chance(0.5)) body.placement.angle = dice_.uniform(-180, 180);
      if (k > 0) top += radius + dx_ * dice_.uniform(0.8, 2);
      body.placement.position = {0, 0, top};
      top += radius;
      body.velocity = speed_ * dice_.uniform(0, 1) * dice_.direction();
      if (dice_.chance(0.3)) body.spin = speed_ / radius * dice_.uniform(0, 1) * dice_.direction();
      if (dice_.chance(0.3)) body.mass_factor = dice_.uniform(0.3, 1.05);
      if (dice_.chance(0.3)) body.jitter = dice_.uniform(0, 0.1), body.seed = dice_.below(1000);
      if (k == 0) first_radius_ = radius;
      scene_.bodies.push_back(body);
    }
    const double middle = (top - first_radius_) / 2;
    for (Body& body : scene_.bodies) body.placement.position = body.placement.position - Vec3d{0, 0, middle} + centre_;
    reach_ = (top + first_radius_) / 2;
  }

  /// A shape inside a ball.
  BodyShape shape(double radius) {
    switch (dice_.below(4)) {
      case 0: {
        const double a = dice_.uniform(0.3, 1), b = dice_.uniform(0.3, 1), c = dice_.uniform(0.3, 1);
        const double edge = 2 * radius / std::sqrt(a * a + b * b + c * c);
        return Box{{std::max(a * edge, dx_), std::max(b * edge, dx_), std::max(c * edge, dx_)}};
      }
      case 1:
        return Sphere{radius};
      case 2: {
        const double slope = dice_.uniform(0.3, 1.2);
        return Cylinder{radius * std::cos(slope), 2 * radius * std::sin(slope)};
      }
      default:
        return Mesh{SESSILE_SOURCE_DIR "/tests/property/octahedron.obj", radius};
    }
  }

  /// Makes a body as large as it takes to hold so many particles; the factor on its lengths.
  double enlarge(Body& body, double particles) const {
    const double factor = std::cbrt(particles / estimate_fill(body, dx_));
    struct Scale {
      double factor;
      void operator()(Box& box) const { box.size = factor * box.size; }
      void operator()(Sphere& sphere) const { sphere.radius *= factor; }
      void operator()(Cylinder& cylinder) const { cylinder.radius *= factor, cylinder.height *= factor; }
      void operator()(Mesh& mesh) const { mesh.scale *= factor; }
    };
    std::visit(Scale{factor}, body.shape);
    return factor;
  }

  void surroundings() {
    const double margin = dx_ * dice_.uniform(1.1, 3);
    const double half = reach_ + margin;
    switch (dice_.below(6)) {
      case 0:  // free space
        break;
      case 1:
        floor(margin);
        break;
      case 2:
        container(half);
        break;
      default:
        domain(half);
    }
    if (dice_.chance(0.4)) obstacle();
  }

  Solid solid(SolidShape shape, const Vec3d& offset) {
    Solid made;
    made.shape = std::move(shape);
    made.placement.position = centre_ + offset;
    if (dice_.chance(0.3)) made.spacing = dx_ * dice_.uniform(0.5, 1.2);
    if (dice_.chance(0.3)) made.layers = dice_.from(2, 3);
    if (dice_.chance(0.3)) made.adhesion = dice_.magnitude(0.1, 10);
    if (dice_.chance(0.3)) made.viscosity = scene_.fluid.viscosity * dice_.uniform(0, 3);
    return made;
  }

  void floor(double margin) {
    scene_.solids.push_back(
        solid(Plate{dx_ * dice_.uniform(2, 20), dx_ * dice_.uniform(2, 20)}, {0, 0, -reach_ - margin}));
  }

  void container(double half) {
    const double height = dice_.uniform(1, 1.5) * half;
    Solid box = solid(Container{{2 * half, 2 * half, 2 * height}}, {0, 0, height - half});
    if (dice_.chance(0.3)) {
      box.placement.axis = dice_.direction();
      box.placement.angle = dice_.uniform(-180, 180);
    }
    scene_.solids.push_back(box);
  }

  void domain(double half) {
    const auto edge = [&] { return static_cast<Edge>(dice_.below(3)); };
    Domain box;
    half = std::max(half, 1.6 * scene_.support_radius());
    const Vec3d reach{half * dice_.uniform(1, 1.3), half * dice_.uniform(1, 1.3), half * dice_.uniform(1, 1.3)};
    box.min = centre_ - reach;
    box.max = centre_ + reach;
    box.x = edge(), box.y = edge(), box.z = edge();
    if (dice_.chance(0.3)) box.x = box.y = box.z = edge();
    scene_.domain = box;
  }

  /// A solid beside the bodies, on a random side: below them by preference.
  void obstacle() {
    const double radius = dx_ * dice_.uniform(2, 4);
    const Vec3d side = dice_.chance(0.6) ? Vec3d{0, 0, -1} : dice_.direction();
    SolidShape shape = Sphere{radius};
    switch (dice_.below(4)) {
      case 0:
        shape = Box{{radius, radius * dice_.uniform(0.1, 1), radius * dice_.uniform(0.1, 1)}};
        break;
      case 1:
        shape = Cylinder{radius / 2, radius};
        break;
      case 2:
        shape = Mesh{SESSILE_SOURCE_DIR "/tests/property/octahedron.obj", radius};
        break;
      default:
        break;
    }
    Solid made = solid(shape, (reach_ + radius + dx_ * dice_.uniform(0.6, 2)) * side);
    made.placement.axis = dice_.direction();
    made.placement.angle = dice_.uniform(0, 360);
    scene_.solids.push_back(made);
  }

  /// One or two layers side by side above the bodies, with one velocity and one mass.
  void emitters() {
    Emitter emitter;
    const double v = speed_ * dice_.uniform(0.3, 1), width = dx_ * dice_.uniform(2, 5);
    emitter.shape = dice_.chance(0.5) ? LayerShape(Disc{width / 2}) : LayerShape(Rectangle{width, 3 * dx_});
    emitter.velocity = {0, 0, -v};
    if (dice_.chance(0.3)) emitter.mass_factor = dice_.uniform(0.3, 1);
    if (dice_.chance(0.7)) {
      emitter.interval = dx_ / v * dice_.uniform(0.8, 2);
      emitter.start = dx_ / v * dice_.uniform(0, 2);
      if (dice_.chance(0.5)) emitter.count = dice_.from(1, 10);
    } else {
      emitter.times = {0, dx_ / v, 2.5 * dx_ / v};
    }
    const double up = reach_ - dx_ * dice_.uniform(0, 1);
    emitter.placement.position = centre_ + Vec3d{0, 0, up};
    scene_.emitters = {emitter};
    if (dice_.chance(0.3)) {
      emitter.placement.position = emitter.placement.position + Vec3d{width + 3 * dx_, 0, 0};
      scene_.emitters.push_back(emitter);
    }
  }

  void time() {
    scene_.time.dt_max = dx_ / speed_;
    scene_.time.dt_min = 1e-9 * scene_.time.dt_max;
    scene_.time.cfl = dice_.uniform(0.1, 0.4);
    scene_.time.end = 1000 * scene_.time.dt_max;
    scene_.output.frame_interval = scene_.time.end / 100;
  }

  Dice dice_;
  bool large_;  // whether loops over particles have several blocks
  Scene scene_;
  double dx_ = 0;
  double speed_ = 0;  // what velocities of the scene are measured in [m/s]
  Vec3d centre_{};
  double reach_ = 0, first_radius_ = 0;
};

}  // namespace

Scene random_scene(unsigned seed) { return SceneMaker(seed).make(); }

}  // namespace sessile::test
