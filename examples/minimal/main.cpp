// Runs a scene to its end and prints its kinetic energy: minimal SCENE
#include <sessile/core/error.h>
#include <sessile/scene/read.h>
#include <sessile/simulation.h>

#include <cmath>
#include <cstdio>

int main(int argc, char** argv) try {
  sessile::Simulation liquid(sessile::read_scene(argc > 1 ? argv[1] : "scenes/drop.json"));
  const double particle_mass = liquid.scene().fluid.rest_density * std::pow(liquid.scene().spacing, 3);  // [kg]
  while (!liquid.finished()) {
    liquid.step();
    double energy = 0;  // [J]
    const auto& particles = liquid.particles();
    for (std::size_t i = 0; i < particles.size(); ++i) {
      energy += 0.5 * particle_mass * particles.mass[i] * sessile::squared_length(particles.velocity[i]);
    }
    std::printf("%8.4f s  %10.4g J\n", liquid.time(), energy);
  }
} catch (const sessile::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
