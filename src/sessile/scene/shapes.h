#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <variant>

#include "sessile/core/fields.h"
#include "sessile/core/vec.h"

/// The shapes a scene is made of. Each is centred on its own origin, in its own axes; a Placement puts it into the
/// world.
namespace sessile {

/// Where a shape stands: first turned about `axis` by `angle`, then moved to `position`.
struct Placement {
  Vec3d position{};
  Vec3d axis{0, 0, 1};
  double angle = 0;

  static constexpr auto fields() {
    using T = Placement;
    return std::tuple{
        field(&T::position, "position", "m", any_number, "where the shape's centre stands"),
        field(&T::axis, "axis", "", any_number, "axis the shape is turned about; any length but zero"),
        field(&T::angle, "angle", "deg", any_number, "angle the shape is turned by, right-handed"),
    };
  }

  Vec3d to_world(const Vec3d& local) const;
  Vec3d to_local(const Vec3d& world) const;
  Vec3d turn(const Vec3d& direction) const;  ///< rotation alone
};

struct Box {
  Vec3d size{};

  static constexpr std::string_view name = "box";
  static constexpr std::string_view summary = "a box centred on its position";
  static constexpr auto fields() {
    return std::tuple{required(field(&Box::size, "size", "m", positive, "edge lengths"))};
  }
};

struct Sphere {
  double radius = 0;

  static constexpr std::string_view name = "sphere";
  static constexpr std::string_view summary = "a ball centred on its position";
  static constexpr auto fields() {
    return std::tuple{required(field(&Sphere::radius, "radius", "m", positive, "radius"))};
  }
};

struct Cylinder {
  double radius = 0;
  double height = 0;

  static constexpr std::string_view name = "cylinder";
  static constexpr std::string_view summary = "a cylinder along its own z axis, centred on its position";
  static constexpr auto fields() {
    return std::tuple{required(field(&Cylinder::radius, "radius", "m", positive, "radius")),
                      required(field(&Cylinder::height, "height", "m", positive, "length along the axis"))};
  }
};

/// A closed triangle surface from an OBJ, STL or PLY file. Paths are relative to the scene file.
struct Mesh {
  std::string file;
  double scale = 1;

  static constexpr std::string_view name = "mesh";
  static constexpr std::string_view summary = "a triangle mesh from an OBJ, STL or PLY file";
  static constexpr auto fields() {
    return std::tuple{required(field(&Mesh::file, "file", "path of the mesh, relative to the scene file")),
                      field(&Mesh::scale, "scale", "", positive, "factor on the file's lengths")};
  }
};

/// A flat rectangle without thickness, in its own xy plane. As a solid its samples lie in the plane and, with more
/// than one layer, below it.
struct Plate {
  double width = 0;
  double depth = 0;

  static constexpr std::string_view name = "plate";
  static constexpr std::string_view summary = "a flat rectangle in its own xy plane; more layers grow downwards";
  static constexpr auto fields() {
    return std::tuple{required(field(&Plate::width, "width", "m", positive, "length along its x axis")),
                      required(field(&Plate::depth, "depth", "m", positive, "length along its y axis"))};
  }
};

/// A box whose inside holds the fluid: an inward box. More layers grow outwards.
struct Container {
  Vec3d size{};

  static constexpr std::string_view name = "container";
  static constexpr std::string_view summary = "a box that holds fluid inside; more layers grow outwards";
  static constexpr auto fields() {
    return std::tuple{required(field(&Container::size, "size", "m", positive, "inner edge lengths"))};
  }
};

/// A flat disc in its own xy plane (emitters).
struct Disc {
  double radius = 0;

  static constexpr std::string_view name = "disc";
  static constexpr std::string_view summary = "a flat disc in its own xy plane";
  static constexpr auto fields() {
    return std::tuple{required(field(&Disc::radius, "radius", "m", positive, "radius"))};
  }
};

/// A flat rectangle in its own xy plane (emitters).
struct Rectangle {
  double width = 0;
  double depth = 0;

  static constexpr std::string_view name = "rectangle";
  static constexpr std::string_view summary = "a flat rectangle in its own xy plane";
  static constexpr auto fields() {
    return std::tuple{required(field(&Rectangle::width, "width", "m", positive, "length along its x axis")),
                      required(field(&Rectangle::depth, "depth", "m", positive, "length along its y axis"))};
  }
};

using BodyShape = std::variant<Box, Sphere, Cylinder, Mesh>;
using SolidShape = std::variant<Box, Plate, Sphere, Cylinder, Container, Mesh>;
using LayerShape = std::variant<Rectangle, Disc>;

}  // namespace sessile
