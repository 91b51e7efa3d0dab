#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "bench/context.h"
#include "ceiling/ceiling.h"
#include "machine.h"

namespace sessile::app::bench {
namespace {

constexpr std::size_t kib = 1024, mib = 1024 * kib;

std::string size_text(std::size_t bytes) {
  return bytes >= mib ? fmt::format("{} MiB", bytes / mib) : fmt::format("{} KiB", bytes / kib);
}

/// Measures with one thread and with all; returns the most that all reached.
template <class Rate>
double measure(Context& context, const std::string& key, const std::string& what, const std::string& unit,
               const Rate& rate) {
  double most = 0;
  for (const int threads : std::set<int>{1, context.threads}) {
    Figure figure{fmt::format("ceilings.{}.{}", key, threads),
                  fmt::format("{}, {} thread{}", what, threads, threads == 1 ? "" : "s"),
                  unit,
                  {}};
    // A ceiling that was disturbed in every sample would make all shares look better than they are.
    const int samples = context.particles > 0 ? context.runs : std::max(context.runs, 5);
    for (int k = 0; k < samples; ++k) figure.samples.push_back(rate(threads));
    most = figure.greatest();  // a ceiling: what lies below was disturbed
    context.report.add(std::move(figure));
  }
  return most;
}

}  // namespace

void measure_ceilings(Context& context) {
  using namespace ceiling;
  const bool trial = context.particles > 0;
  const double time = trial ? 0.002 : 0.05;  // of a sample [s]
  context.report.section("What this machine can do");
  // In the second cache of a core, in the last cache, in memory.
  std::vector<std::size_t> sizes{256 * kib, 4 * mib, 32 * mib};
  if (!trial && available_memory() > 2048 * mib) sizes.push_back(512 * mib);
  Ceilings& all = context.ceilings;
  for (const std::size_t bytes : sizes) {
    const double rate = measure(context, "read." + std::to_string(bytes), "read in order, " + size_text(bytes), "B/ns",
                                [&](int threads) { return read_bandwidth(bytes, threads, time); });
    all.read.push_back({static_cast<double>(bytes), rate});
  }
  for (const std::size_t bytes : {sizes.front(), sizes.back()}) {
    measure(context, "triad." + std::to_string(bytes), "a = b + s c, " + size_text(bytes), "B/ns",
            [&](int threads) { return triad_bandwidth(bytes, threads, time); });
  }
  for (const std::size_t points : {std::size_t{2048}, std::size_t{65536}}) {
    const double rate =
        measure(context, "gather." + std::to_string(points), fmt::format("gathered from 3 x {} numbers", points),
                "numbers/ns", [&](int threads) { return gather_rate(points, threads, time); });
    all.gathers = std::max(all.gathers, rate);
  }
  all.operations = measure(context, "multiply_add", "products with sums", "lanes/ns",
                           [&](int threads) { return multiply_add_rate(threads, time); });
}

Bound Ceilings::bound(const PassWork& work, double n, double neighbors, int threads) const {
  const double bytes = work.streamed + 4 * neighbors;
  // The bandwidth of the next smaller set: never less than what this one can have.
  double bandwidth = read.front().bytes_per_ns;
  for (const Bandwidth& each : read) {
    if (each.bytes <= n * bytes) bandwidth = each.bytes_per_ns;
  }
  Bound bound{threads * neighbors * work.gathered / gathers, "gathers"};
  const auto raise = [&](double value, const char* by) {
    if (value > bound.value) bound = {value, by};
  };
  raise(threads * neighbors * work.operations / operations, "arithmetic");
  raise(threads * bytes / bandwidth, "memory");
  return bound;
}

}  // namespace sessile::app::bench
