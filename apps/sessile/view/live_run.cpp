#include "view/live_run.h"

#include <omp.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "sessile/core/error.h"
#include "sessile/measure/diagnostics.h"
#include "shown.h"

namespace sessile::viewer {
namespace {

// A moment that nobody took for so long is replaced by a newer one; before, copies would be made for nobody.
constexpr std::chrono::milliseconds stale{30};

// Time that slow steps lost beyond this is not made up for.
constexpr std::chrono::milliseconds most_behind{100};

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

LiveRun::LiveRun(Simulation simulation, int threads)
    : simulation_(std::move(simulation)),
      threads_(threads),
      stage_(app::stage_of(simulation_.scene())),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

template <class F>
void LiveRun::order(F&& f) {
  {
    const std::lock_guard lock(mutex_);
    f(orders_);
  }
  wake_.notify_one();
}

void LiveRun::play() {
  order([](Orders& orders) { orders.play = true; });
}
void LiveRun::pause() {
  order([](Orders& orders) {
    orders.play = false;
    orders.steps = 0;
  });
}
void LiveRun::step() {
  order([](Orders& orders) { ++orders.steps; });
}
void LiveRun::reset(Scene scene) {
  order([&](Orders& orders) {
    orders.reset.emplace(std::move(scene));
    orders.change.reset();
    orders.steps = 0;
  });
}
void LiveRun::change(Scene scene) {
  order([&](Orders& orders) { orders.change.emplace(std::move(scene)); });
}
void LiveRun::limit(std::optional<double> speed) {
  order([&](Orders& orders) { orders.speed.emplace(speed); });
}
void LiveRun::colour_by(std::string field) {
  order([&](Orders& orders) { orders.field.emplace(std::move(field)); });
}

LiveNews LiveRun::take() {
  LiveNews news;
  const std::lock_guard lock(mutex_);
  std::swap(news, news_);
  news_.state = news.state;
  news_.fault = news.fault;
  return news;
}

void LiveRun::work(const std::stop_token& stop) {
  if (threads_ > 0) omp_set_num_threads(threads_);  // holds for the thread that says it
  tell_stage();
  hand_over(true);
  while (!stop.stop_requested()) {
    obey(next_orders(stop));
    const bool playing = state_ == LiveState::playing && Clock::now() >= due();
    if (!stop.stop_requested() && (steps_left_ > 0 || playing)) advance();
  }
}

/// Waits for something to do: an order, or that the next step is due.
LiveRun::Orders LiveRun::next_orders(const std::stop_token& stop) {
  const auto asked = [&] { return orders_.any(); };
  std::unique_lock lock(mutex_);
  if (steps_left_ == 0) {
    if (state_ == LiveState::playing) {
      wake_.wait_until(lock, stop, due(), asked);
    } else {
      wake_.wait(lock, stop, asked);
    }
  }
  return std::exchange(orders_, {});
}

void LiveRun::obey(Orders orders) {
  if (orders.reset) start_anew(std::move(*orders.reset));
  if (orders.change) take_over(std::move(*orders.change));
  if (orders.speed) speed_ = *orders.speed;
  if (orders.field) change_field(std::move(*orders.field));
  if (orders.play && !*orders.play) {
    steps_left_ = 0;
    if (state_ == LiveState::playing) {
      hand_over(true);
      settle(LiveState::paused);
    }
  }
  if (state_ == LiveState::failed) return;
  if (orders.play && *orders.play) settle(simulation_.finished() ? LiveState::ended : LiveState::playing);
  steps_left_ += orders.steps;
  if (orders.play || orders.speed || orders.reset) set_pace();
}

void LiveRun::start_anew(Scene scene) {
  try {
    Simulation fresh(std::move(scene));
    stage_ = app::stage_of(fresh.scene());
    simulation_ = std::move(fresh);
  } catch (const std::exception& e) {
    fail(e.what());
    return;
  }
  steps_left_ = 0;
  milliseconds_ = 0;
  fail("");
  if (state_ != LiveState::playing) settle(LiveState::paused);
  tell_stage();
  hand_over(true);
}

void LiveRun::take_over(Scene scene) {
  try {
    simulation_.retune(std::move(scene));
  } catch (const std::exception& e) {
    fail(e.what());
    return;
  }
  if (state_ != LiveState::failed) fail("");
  if (state_ == LiveState::ended && !simulation_.finished()) settle(LiveState::paused);
  tell_scene();
  hand_over(true);
}

void LiveRun::advance() {
  const bool single = steps_left_ > 0;
  if (single) --steps_left_;
  try {
    const auto before = Clock::now();
    simulation_.step();
    milliseconds_ = 1e3 * seconds(Clock::now() - before);
  } catch (const std::exception& e) {
    steps_left_ = 0;
    fail(e.what(), LiveState::failed);  // the last good moment stays in sight
    return;
  }
  if (Clock::now() - due() > most_behind) set_pace();
  const bool ends = state_ == LiveState::playing && simulation_.finished();
  hand_over(single || ends);
  if (ends) settle(LiveState::ended);  // only now: who knows that it has ended has its last moment
}

/// Copies what there is to see. Between two steps that follow each other only if the last copy was taken, or is stale.
void LiveRun::hand_over(bool at_once) {
  const auto now = Clock::now();
  if (!at_once && now - handed_over_ < stale) {
    const std::lock_guard lock(mutex_);
    if (news_.moment) return;
  }
  handed_over_ = now;
  if (state_ == LiveState::failed) return;
  draw::Moment moment = app::moment_of(simulation_, field_, stage_);
  LiveSample measured = sample();
  std::optional<draw::Moment> replaced;  // freed after the lock
  const std::lock_guard lock(mutex_);
  replaced = std::exchange(news_.moment, std::move(moment));
  news_.samples.push_back(measured);
}

LiveSample LiveRun::sample() const {
  LiveSample s;
  const Particles& p = simulation_.particles();
  const Motion moves =
      motion(p.position, p.velocity, p.mass, simulation_.units().particle_mass(), simulation_.scene().gravity);
  s.time = simulation_.time();
  s.wall = seconds(Clock::now() - start_);
  s.milliseconds = milliseconds_;
  s.max_speed = moves.max_speed;
  s.potential_energy = moves.potential_energy;
  s.density_error = compression(simulation_.density()).average;
  s.steps = simulation_.totals().steps;
  s.particles = static_cast<std::int64_t>(p.size());
  s.out = simulation_.totals().out;
  s.lost = simulation_.totals().lost;
  s.last = simulation_.last_step();
  return s;
}

/// Tells which scene runs from now on, and what can colour it. A force that is gone colours no longer.
void LiveRun::tell_scene() {
  Scene scene = simulation_.scene();
  std::vector<std::string> fields = app::shown_fields(simulation_);
  if (std::find(fields.begin(), fields.end(), field_) == fields.end()) field_ = "speed";
  const std::lock_guard lock(mutex_);
  news_.scene = std::move(scene);
  news_.fields = std::move(fields);
}

/// The same of a new simulation; what has not been taken of the one before is dropped.
void LiveRun::tell_stage() {
  tell_scene();
  std::optional<draw::Stage> stage(stage_);
  const std::lock_guard lock(mutex_);
  std::swap(news_.stage, stage);
  news_.moment.reset();
  news_.samples.clear();
}

void LiveRun::change_field(std::string field) {
  const std::vector<std::string> fields = app::shown_fields(simulation_);
  if (std::find(fields.begin(), fields.end(), field) == fields.end()) return;
  field_ = std::move(field);
  hand_over(true);
}

void LiveRun::fail(const std::string& fault, std::optional<LiveState> state) {
  if (state) state_ = *state;
  const std::lock_guard lock(mutex_);
  news_.fault = fault;
  news_.state = state_;
}

void LiveRun::settle(LiveState state) {
  state_ = state;
  const std::lock_guard lock(mutex_);
  news_.state = state;
}

void LiveRun::set_pace() {
  pace_start_ = Clock::now();
  pace_time_ = simulation_.time();
}

/// When the next step may begin, so that the run is not faster than asked.
LiveRun::Clock::time_point LiveRun::due() const {
  if (!speed_ || *speed_ <= 0) return pace_start_;
  const double ahead = (simulation_.time() - pace_time_) / *speed_;
  return pace_start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(ahead));
}

}  // namespace sessile::viewer
