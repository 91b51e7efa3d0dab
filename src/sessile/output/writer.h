#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <mutex>
#include <queue>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "sessile/output/frames.h"
#include "sessile/output/snapshot.h"

namespace sessile {

/// Writes frames on a thread of its own, so that the simulation does not wait for the disk.
///
/// A folder holds frame_000000.vtp, frame_000001.vtp ... for each format, and frames.pvd when vtp is among them; each
/// file is whole, and the collection lists whole frames only. After the first error nothing more is written.
class FrameWriter {
 public:
  /// Frames that wait at most; then push() does too.
  static constexpr std::size_t queue_length = 2;

  /// `formats` are names from frame_formats(). Throws Error for any other. The folder must exist.
  /// `times` [s]: of frames that are in the folder already, from the first on; new ones are numbered after them.
  FrameWriter(std::filesystem::path folder, std::span<const std::string> formats, std::vector<double> times = {});

  /// Waits for what has been pushed; an error that nobody asked for is dropped.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Hands a frame over; frames are numbered in the order they come. Waits while the queue is full.
  /// Throws what went wrong with an earlier frame (FileError), at each call.
  void push(Snapshot snapshot);

  /// Waits until every frame that has been pushed is on disk, and gives the times [s] of all that are there.
  /// Throws what went wrong.
  std::vector<double> settle();

  /// Writes the solids' samples, once, before it returns: solids.vtp, solids.ply. Throws FileError.
  void write_solids(const Snapshot& solids) const;

  /// Waits until everything is on disk. Throws what went wrong, unless push() has thrown it already.
  /// Nothing can be pushed afterwards; closing again does nothing.
  void close();

  std::int64_t frames_written() const;  ///< whole ones
  double seconds() const;               ///< that the thread has worked [s]

 private:
  void work();
  void write(const Snapshot& snapshot);

  const std::filesystem::path folder_;
  std::vector<const FrameFormat*> formats_;

  mutable std::mutex mutex_;  // guards what stands below it
  std::condition_variable changed_;
  std::queue<Snapshot> queue_;
  bool closing_ = false;
  bool reported_ = false;
  std::exception_ptr error_;
  std::vector<double> times_;  // of the frames that are there whole
  bool idle_ = true;           // whether the thread waits for frames
  double seconds_ = 0;

  std::jthread thread_;  // last, so that it starts when all else is there
};

}  // namespace sessile
