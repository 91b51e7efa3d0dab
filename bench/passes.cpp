// ns per particle for the parts of a step, on a jittered lattice of 32k, 262k and 1M particles at h = 2 dx.
// `ns` is wall time, `ns_core` wall time times threads.

#include <benchmark/benchmark.h>

#include <map>

#include "sessile/forces/force.h"
#include "sessile/pressure/pressure_force.h"
#include "sessile/pressure/solve.h"
#include "sessile/simulation.h"
#include "support/cloud.h"

namespace {

using namespace sessile;

const test::Cloud& cloud_of(int edge) {
  static std::map<int, test::Cloud> clouds;
  auto& cloud = clouds[edge];
  if (cloud.particles.size() == 0) {
    cloud = test::lattice(edge, 0.2);
    cloud.look_around();
  }
  return cloud;
}

void report(benchmark::State& state, const test::Cloud& cloud) {
  using benchmark::Counter;
  const auto n = static_cast<double>(cloud.particles.size());
  const auto per_particle = Counter::kIsIterationInvariantRate | Counter::kInvert;
  state.counters["ns"] = Counter(n * 1e-9, per_particle);
  state.counters["ns_core"] = Counter(n * 1e-9 / omp_get_max_threads(), per_particle);
  double pairs = 0;
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) pairs += cloud.near.count(i);
  state.counters["neighbors"] = pairs / n;
}

template <class Pass>
void run(benchmark::State& state, const Pass& pass) {
  const test::Cloud& cloud = cloud_of(static_cast<int>(state.range(0)));
  for (auto _ : state) pass(cloud);
  report(state, cloud);
}

const GridShape shape = GridShape::make(0.2, {}, {});

void sort(benchmark::State& state) {
  Particles particles = cloud_of(static_cast<int>(state.range(0))).particles;
  Grid grid;
  run(state, [&](const test::Cloud&) {
    grid.build(particles.position, shape);
    particles.reorder(grid.order());
  });
}

void neighbor_list(benchmark::State& state) {
  NeighborList list;
  run(state, [&](const test::Cloud& c) {
    list.build({c.particles.position, c.grid}, {c.particles.position, c.grid}, c.space, Real(0.2));
  });
}

void density(benchmark::State& state) {
  Array<Real> rho;
  run(state, [&](const test::Cloud& c) { compute_density(c.view(), rho); });
}

void normals(benchmark::State& state) {
  Array3 n;
  run(state, [&](const test::Cloud& c) { compute_normals(c.view(), n); });
}

void viscosity(benchmark::State& state) {
  Array3 a;
  run(state, [&](const test::Cloud& c) {
    a.assign(c.particles.size(), {});
    add_viscosity(c.view(), 20, a);
  });
}

void surface_feature(benchmark::State& state) {
  Array3 a;
  run(state, [&](const test::Cloud& c) {
    a.assign(c.particles.size(), {});
    SurfaceFeature{}.add_acceleration(c.view(), a);
  });
}

void pressure_coefficients(benchmark::State& state) {
  PressureScratch scratch;
  run(state,
      [&](const test::Cloud& c) { sessile::pressure_coefficients(c.view(), c.particles.velocity, 0.002, scratch); });
}

void pressure_acceleration(benchmark::State& state) {
  Array3 a;
  Array<Real> stress;
  run(state, [&](const test::Cloud& c) { sessile::pressure_acceleration(c.view(), c.density, stress, a); });
}

void pressure_divergence(benchmark::State& state) {
  Array<Real> change;
  run(state, [&](const test::Cloud& c) { density_change(c.view(), c.normal, 0.002, change); });
}

/// One whole step of a falling block with every force, IISPH to 0.01 %.
void whole_step(benchmark::State& state) {
  const int edge = static_cast<int>(state.range(0));
  Scene scene;
  scene.spacing = 0.1;
  scene.time.end = 1;
  scene.time.fixed_dt = 1e-3;
  scene.fluid.viscosity = 20;
  scene.forces = {SurfaceFeature{}};
  Body body;
  body.shape = Box{{0.1 * edge, 0.1 * edge, 0.1 * edge}};
  body.jitter = 0.05;
  scene.bodies = {body};
  Simulation simulation(scene);
  simulation.step();
  const std::int64_t before = simulation.totals().iterations;
  for (auto _ : state) simulation.step();
  const auto n = static_cast<double>(simulation.particles().size());
  const auto per_particle = benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert;
  state.counters["ns"] = benchmark::Counter(n * 1e-9, per_particle);
  state.counters["ns_core"] = benchmark::Counter(n * 1e-9 / omp_get_max_threads(), per_particle);
  state.counters["iterations"] = benchmark::Counter(static_cast<double>(simulation.totals().iterations - before),
                                                    benchmark::Counter::kAvgIterations);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgName("edge")->Arg(32)->Arg(64)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(sort)->Apply(sizes);
BENCHMARK(neighbor_list)->Apply(sizes);
BENCHMARK(density)->Apply(sizes);
BENCHMARK(normals)->Apply(sizes);
BENCHMARK(viscosity)->Apply(sizes);
BENCHMARK(surface_feature)->Apply(sizes);
BENCHMARK(pressure_coefficients)->Apply(sizes);
BENCHMARK(pressure_acceleration)->Apply(sizes);
BENCHMARK(pressure_divergence)->Apply(sizes);
BENCHMARK(whole_step)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
