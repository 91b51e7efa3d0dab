#include "sessile/output/writer.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "sessile/core/error.h"
#include "sessile/output/file.h"

namespace sessile {
namespace {

std::vector<const FrameFormat*> formats_named(std::span<const std::string> names) {
  std::vector<const FrameFormat*> formats;
  for (const std::string& name : names) {
    formats.push_back(find_frame_format(name));
    if (!formats.back()) throw Error(fmt::format("unknown format \"{}\"", name));
  }
  return formats;
}

}  // namespace

FrameWriter::FrameWriter(std::filesystem::path folder, std::span<const std::string> formats, std::vector<double> times)
    : folder_(std::move(folder)),
      formats_(formats_named(formats)),
      times_(std::move(times)),
      thread_([this] { work(); }) {}

FrameWriter::~FrameWriter() {
  try {
    close();
  } catch (...) {  // whoever wants to know calls close()
  }
}

void FrameWriter::push(Snapshot snapshot) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return error_ || closing_ || queue_.size() < queue_length; });
  if (error_) {
    reported_ = true;
    std::rethrow_exception(error_);
  }
  if (closing_) throw Error("a frame came after the writer was closed");
  queue_.push(std::move(snapshot));
  changed_.notify_all();
}

std::vector<double> FrameWriter::settle() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return error_ || (queue_.empty() && idle_); });
  if (error_) {
    reported_ = true;
    std::rethrow_exception(error_);
  }
  return times_;
}

void FrameWriter::write_solids(const Snapshot& solids) const {
  for (const FrameFormat* format : formats_) {
    write_whole(folder_ / solids_file_name(format->name), format->encode(solids));
  }
}

void FrameWriter::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
  if (error_ && !std::exchange(reported_, true)) std::rethrow_exception(error_);
}

std::int64_t FrameWriter::frames_written() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::int64_t>(times_.size());
}

double FrameWriter::seconds() const {
  const std::lock_guard lock(mutex_);
  return seconds_;
}

void FrameWriter::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return closing_ || !queue_.empty(); });
    if (queue_.empty()) return;
    const Snapshot snapshot = std::move(queue_.front());
    queue_.pop();
    idle_ = false;
    changed_.notify_all();

    lock.unlock();
    const auto start = std::chrono::steady_clock::now();
    std::exception_ptr error;
    try {
      write(snapshot);
    } catch (...) {
      error = std::current_exception();
    }
    const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - start;
    lock.lock();

    seconds_ += duration.count();
    if (error) {
      error_ = error;
      queue_ = {};
      changed_.notify_all();
      return;
    }
    times_.push_back(snapshot.time);
    idle_ = true;
    changed_.notify_all();
  }
}

void FrameWriter::write(const Snapshot& snapshot) {
  std::vector<double> times;
  {
    const std::lock_guard lock(mutex_);
    times = times_;
  }
  const auto number = static_cast<std::int64_t>(times.size());
  times.push_back(snapshot.time);
  for (const FrameFormat* format : formats_) {
    const std::string name = frame_file_name(number, format->name);
    write_whole(folder_ / name, format->encode(snapshot));
    if (format->name == "vtp") write_whole(folder_ / collection_file_name, encode_collection(times));
  }
}

}  // namespace sessile
