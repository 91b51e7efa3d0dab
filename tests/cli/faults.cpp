/// A machine with faults, for LD_PRELOAD: calls of the C library fail, wait or tell the wrong time, as the environment
/// says. Everything else goes through.
///
///   FAULT_CALL=fsync     which call: write, fsync, rename, flock, pthread_create, clock
///   FAULT_PATH=frame_    of files whose path holds this text only
///   FAULT_AFTER=3        so many such calls still go through
///   FAULT_ERROR=28       and then they fail with this errno
///   FAULT_HOLD=FILE      or make FILE and wait, for ever
///   FAULT_NOTE=FILE      the clock of the day jumps at every look; who waits by it is noted in FILE
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

template <class Call>
Call real(const char* name) {
  Call call = nullptr;
  void* const found = dlsym(RTLD_NEXT, name);
  std::memcpy(&call, &found, sizeof call);
  return call;
}

const char* setting(const char* name) {
  const char* const text = getenv(name);
  return text == nullptr ? "" : text;
}

std::atomic<long> seen = 0;

/// Whether this call is one that fails; it then never returns, or sets errno.
bool fails(const char* call, const char* path) {
  if (std::strcmp(setting("FAULT_CALL"), call) != 0 || std::strstr(path, setting("FAULT_PATH")) == nullptr) return false;
  if (++seen <= atol(setting("FAULT_AFTER"))) return false;
  if (const char* const hold = setting("FAULT_HOLD"); *hold != '\0') {
    close(open(hold, O_WRONLY | O_CREAT, 0600));
    for (;;) pause();
  }
  errno = atoi(setting("FAULT_ERROR"));
  return true;
}

/// The path of an open file.
struct Path {
  explicit Path(int descriptor) {
    char link[64];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t size = readlink(link, text, sizeof text - 1);
    text[size > 0 ? size : 0] = '\0';
  }
  char text[4096];
};

/// The clock of the day jumps by an hour, on and back, at every second look.
bool jumps() { return std::strcmp(setting("FAULT_CALL"), "clock") == 0; }

time_t jump() { return ++seen % 2 == 0 ? 3600 : -3600; }

void note(const char* call) {
  if (!jumps()) return;
  if (FILE* const file = std::fopen(setting("FAULT_NOTE"), "a")) {
    std::fprintf(file, "%s\n", call);
    std::fclose(file);
  }
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t size) {
  if (fails("write", Path(descriptor).text)) return -1;
  return real<ssize_t (*)(int, const void*, size_t)>("write")(descriptor, bytes, size);
}

int fsync(int descriptor) {
  if (fails("fsync", Path(descriptor).text)) return -1;
  return real<int (*)(int)>("fsync")(descriptor);
}

int rename(const char* from, const char* to) noexcept {
  if (fails("rename", to)) return -1;
  return real<int (*)(const char*, const char*)>("rename")(from, to);
}

int flock(int descriptor, int operation) noexcept {
  if (fails("flock", Path(descriptor).text)) return -1;
  return real<int (*)(int, int)>("flock")(descriptor, operation);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* how, void* (*work)(void*), void* with) noexcept {
  if (fails("pthread_create", "")) return errno;
  return real<int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create")(thread, how, work,
                                                                                                    with);
}

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const int result = real<int (*)(clockid_t, timespec*)>("clock_gettime")(clock, now);
  if (result == 0 && clock == CLOCK_REALTIME && jumps()) now->tv_sec += jump();
  return result;
}

int gettimeofday(timeval* now, void* zone) noexcept {
  const int result = real<int (*)(timeval*, void*)>("gettimeofday")(now, zone);
  if (result == 0 && jumps()) now->tv_sec += jump();
  return result;
}

int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const timespec* until) {
  note("pthread_cond_timedwait");
  return real<int (*)(pthread_cond_t*, pthread_mutex_t*, const timespec*)>("pthread_cond_timedwait")(condition, mutex,
                                                                                                    until);
}

}  // extern "C"
