#pragma once

#include <cstdint>
#include <string>

namespace sessile {

class Simulation;

/// How far a run may go before its result cannot be believed.
struct SoundnessLimits {
  double pressure_work = 0.01;  ///< greatest work of pressure, over the greatest kinetic energy of the run
  double density_error = 1e-3;  ///< mean over the steps of the average compression at the new positions
  double unconverged = 0.01;    ///< share of pressure solves that end above their error
  double runaway = 0.5;         ///< work of pressure so far, over the greatest kinetic energy so far, after 50 steps
  double hopeless = 0.1;        ///< share of the solves so far that ended above their error, once there were 50
};

/// What soundness looks at after a step. Energies and counts are since the start.
struct SoundnessState {
  double time = 0;            ///< [s]
  double kinetic_energy = 0;  ///< [J]
  double pressure_work = 0;   ///< of the pressure's accelerations [J]
  double density_error = 0;   ///< average compression at the new positions
  std::int64_t steps = 0;
  std::int64_t solves = 0;
  std::int64_t unconverged_solves = 0;
  std::int64_t lost = 0;  ///< passages through a solid, positions that are not finite
};

/// Whether a run can be believed, and if not, since when and why.
struct Verdict {
  bool sound = true;
  double time = 0;     ///< at which it became unsound [s]; judged at the end: the end's
  std::string reason;  ///< a sentence with figures; "" for a sound run
};

/// Judges a run while it goes on. It is unsound
///   - as soon as a particle passes through a solid or has no finite position;
///   - when pressure has at any time put more energy into the liquid than a share of the run's greatest kinetic energy:
///     the pressure of an incompressible liquid between resting walls does no work on it, and a scheme that leaves some
///     compression may only take energy away. What kinetic energy rises above its start plus the work of forces and
///     what emission brings comes from steps that are too long. Judged at the end, or as soon as it runs away;
///   - at the end, when the mean density error, or the share of solves above their error, is over its limit; the latter
///     as soon as it is hopeless.
class Soundness {
 public:
  explicit Soundness(const SoundnessLimits& limits = {}) : limits_(limits) {}

  /// Called after every step.
  void look(const Simulation& simulation);
  void look(const SoundnessState& state);

  /// Called when the run has failed: it is unsound, for the reason that the failure gives.
  void fail(double time, const std::string& message);

  /// Called once at the end of a run that came to its end.
  void finish();

  const SoundnessLimits& limits() const { return limits_; }
  const Verdict& verdict() const { return verdict_; }
  double pressure_work_share() const;                           ///< greatest work over greatest kinetic energy
  double density_error() const;                                 ///< mean over the steps so far
  double density_error_max() const { return greatest_error_; }  ///< greatest of any step
  double unconverged_share() const;                             ///< of the solves so far

 private:
  void judge(double time, std::string reason);
  void judge_pressure_work(double limit);
  void judge_solves(double limit);

  SoundnessLimits limits_;
  Verdict verdict_;
  SoundnessState last_;
  double greatest_energy_ = 0, greatest_work_ = 0, time_of_greatest_work_ = 0;
  double error_sum_ = 0, greatest_error_ = 0;
};

}  // namespace sessile
