#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "draw/moment.h"
#include "sessile/simulation.h"

namespace sessile::viewer {

enum class LiveState {
  paused,
  playing,
  ended,  ///< has reached the scene's end; a single step still goes on
  failed  ///< a step went wrong; only a reset helps
};

/// What is known of a run after one of its steps.
struct LiveSample {
  double time = 0;              ///< [s]
  double wall = 0;              ///< since the thread started [s]
  double milliseconds = 0;      ///< of the step
  double max_speed = 0;         ///< [m/s]
  double density_error = 0;     ///< average compression over rest density
  double potential_energy = 0;  ///< [J]
  std::int64_t steps = 0, particles = 0, out = 0, lost = 0;
  StepReport last{};
};

/// What has happened since one last asked.
struct LiveNews {
  std::optional<draw::Moment> moment;  ///< the newest, when there is one that was not taken yet
  std::vector<LiveSample> samples;     ///< of every moment that was handed over, taken or not
  std::optional<Scene> scene;          ///< as it runs from now on: at the start, after a reset or a change
  std::vector<std::string> fields;     ///< with `scene`: what could colour it
  std::optional<draw::Stage> stage;    ///< when a new simulation took the place of the one before, and at the start
  LiveState state = LiveState::paused;
  std::string fault;  ///< why a step, reset or change failed; stays until one succeeds
};

/// A simulation that runs in a thread of its own and hands over copies of what there is to see: the newest wins. Nobody
/// waits for anybody: the mutex is held to move finished things in and out.
class LiveRun {
 public:
  /// `threads`: for the steps; 0 for all.
  explicit LiveRun(Simulation simulation, int threads = 0);
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  void play();
  void pause();
  void step();                              ///< one more, however many have been asked for
  void reset(Scene scene);                  ///< from the start; keeps playing when it was
  void change(Scene scene);                 ///< between two steps, see Simulation::retune
  void limit(std::optional<double> speed);  ///< simulated seconds per wall second at most
  void colour_by(std::string field);

  LiveNews take();

 private:
  using Clock = std::chrono::steady_clock;

  struct Orders {
    std::optional<bool> play;
    int steps = 0;
    std::optional<Scene> reset, change;
    std::optional<std::optional<double>> speed;
    std::optional<std::string> field;
    bool any() const { return play || steps > 0 || reset || change || speed || field; }
  };

  template <class F>
  void order(F&& f);
  void work(const std::stop_token& stop);
  Orders next_orders(const std::stop_token& stop);
  void obey(Orders orders);
  void start_anew(Scene scene);
  void take_over(Scene scene);
  void advance();
  void hand_over(bool at_once);
  void tell_scene();
  void tell_stage();
  void change_field(std::string field);
  void fail(const std::string& fault, std::optional<LiveState> state = {});
  void settle(LiveState state);
  void set_pace();
  Clock::time_point due() const;
  LiveSample sample() const;

  // The thread's own.
  Simulation simulation_;
  int threads_;
  LiveState state_ = LiveState::paused;
  int steps_left_ = 0;
  draw::Stage stage_;
  std::string field_ = "speed";
  std::optional<double> speed_ = 1;
  Clock::time_point start_ = Clock::now(), pace_start_ = start_, handed_over_{};
  double pace_time_ = 0, milliseconds_ = 0;

  // Both sides'.
  std::mutex mutex_;
  std::condition_variable_any wake_;
  Orders orders_;
  LiveNews news_;

  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace sessile::viewer
