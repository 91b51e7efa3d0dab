#include <array>
#include <string>

#include "sessile/output/snapshot.h"
#include "sessile/simulation.h"

namespace sessile {
namespace {

/// The numbers value(i) of n particles.
template <class F>
ColumnValues numbers(std::size_t n, F&& value) {
  std::vector<float> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<float>(value(i));
  return values;
}

/// The numbers factor * from[i].
ColumnValues scaled(const Array<Real>& from, double factor) {
  return numbers(from.size(), [&](std::size_t i) { return factor * static_cast<double>(from[i]); });
}

/// The lengths of n rows.
ColumnValues counts(const NeighborList& list, std::size_t n) {
  std::vector<std::int64_t> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = list.count(i);
  return values;
}

/// A field and where its numbers come from.
struct Source {
  KnownColumn known;
  ColumnValues (*values)(const Simulation&);
};

constexpr auto sources = std::to_array<Source>({
    {{"id", "", 1, "number of the particle, in order of appearance"},
     [](const Simulation& s) -> ColumnValues {
       return std::vector<std::int64_t>(s.particles().id.begin(), s.particles().id.end());
     }},
    {{"velocity", "m/s", 3, "velocity"},
     [](const Simulation& s) -> ColumnValues { return interleaved(s.particles().velocity); }},
    {{"speed", "m/s", 1, "length of the velocity"},
     [](const Simulation& s) {
       return numbers(s.particles().size(), [&](std::size_t i) { return length(s.particles().velocity[i]); });
     }},
    {{"density", "kg/m^3", 1, "density"},
     [](const Simulation& s) { return scaled(s.density(), s.units().rest_density); }},
    {{"pressure", "Pa", 1, "pressure"},
     [](const Simulation& s) { return scaled(s.particles().pressure, s.units().rest_density); }},
    {{"mass", "kg", 1, "mass"},
     [](const Simulation& s) { return scaled(s.particles().mass, s.units().particle_mass()); }},
    {{"normal", "", 3, "normal n_i of the surface, pointing into the liquid; near zero inside"},
     [](const Simulation& s) -> ColumnValues { return interleaved(s.normal()); }},
    {{"neighbors", "", 1, "number of other fluid particles within the support radius"},
     [](const Simulation& s) { return counts(s.fluid_neighbors(), s.particles().size()); }},
    {{"wall_neighbors", "", 1, "number of samples of solids within the support radius"},
     [](const Simulation& s) { return counts(s.wall_neighbors(), s.particles().size()); }},
});

}  // namespace

std::vector<float> interleaved(const Array3& from) {
  std::vector<float> values(3 * from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    values[3 * i] = static_cast<float>(from.x[i]);
    values[3 * i + 1] = static_cast<float>(from.y[i]);
    values[3 * i + 2] = static_cast<float>(from.z[i]);
  }
  return values;
}

std::vector<KnownColumn> known_columns() {
  std::vector<KnownColumn> known;
  for (const Source& source : sources) known.push_back(source.known);
  known.push_back({"acceleration_<force>", "m/s^2", 3,
                   "acceleration by one force alone: gravity, viscosity, pressure, or a force of the scene"});
  return known;
}

std::optional<Column> plain_column(const Simulation& simulation, std::string_view name) {
  for (const Source& source : sources) {
    const KnownColumn& known = source.known;
    if (known.name == name) {
      return Column{std::string(known.name), std::string(known.unit), known.components, source.values(simulation)};
    }
  }
  return std::nullopt;
}

}  // namespace sessile
