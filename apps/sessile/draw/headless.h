#pragma once

#include <memory>

namespace sessile::draw {

/// An OpenGL 3.3 core context without a display, made current: EGL on a graphics card or in software.
/// Throws Error with a sentence that names what is missing (driver, package) when there is none to be had.
class HeadlessContext {
 public:
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sessile::draw
