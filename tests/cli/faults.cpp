/// A machine with faults, for LD_PRELOAD: calls of the C library fail, wait or tell the wrong time, as the environment
/// says. Everything else goes through.
///
///   FAULT_CALL=fsync     which call: write, fsync, rename, flock, pthread_create (from `main` on), malloc, clock, log
///   FAULT_PATH=frame_    of files whose path holds this text only
///   FAULT_ENDS=1         and whose path ends in it
///   FAULT_AFTER=3        so many such calls still go through
///   FAULT_COUNT=2        then so many fail; all that follow unless given
///   FAULT_ERROR=28       with this errno
///   FAULT_SIZE=4096      of memory, pieces as large as this only [bytes]
///   FAULT_HOLD=FILE      or make FILE, wait until somebody removes it, and go through
///   FAULT_NOTE=FILE      clock: the clock of the day jumps at every look; who waits by it is noted in FILE
///                        log: nothing fails; what is done with files is noted in FILE
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/syscall.h>
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

/// Threads that shared libraries start while they are loaded are not the program's: it has not begun.
bool begun = false;

/// Whether this call is one that fails; errno then says why.
bool fails(const char* call, const char* path) {
  const char* const wanted = setting("FAULT_PATH");
  if (std::strcmp(setting("FAULT_CALL"), call) != 0 || std::strstr(path, wanted) == nullptr) return false;
  const std::size_t size = std::strlen(path), end = std::strlen(wanted);
  if (*setting("FAULT_ENDS") != '\0' && std::strcmp(path + size - end, wanted) != 0) return false;
  const long number = ++seen, after = atol(setting("FAULT_AFTER")), count = atol(setting("FAULT_COUNT"));
  if (number <= after || (count > 0 && number > after + count)) return false;
  if (const char* const hold = setting("FAULT_HOLD"); *hold != '\0') {
    close(open(hold, O_WRONLY | O_CREAT, 0600));
    while (access(hold, F_OK) == 0) usleep(1000);
    return false;
  }
  errno = atoi(setting("FAULT_ERROR"));
  return true;
}

/// Settings of memory are read once: whoever reads the environment may ask for memory.
std::atomic<std::size_t> failing_size = 0;
std::atomic<long> pieces_left = 0;

[[gnu::constructor]] void read_settings() {
  if (std::strcmp(setting("FAULT_CALL"), "malloc") != 0) return;
  pieces_left = atol(setting("FAULT_AFTER"));
  failing_size = static_cast<std::size_t>(atol(setting("FAULT_SIZE")));
}

bool no_memory(std::size_t size) {
  const std::size_t least = failing_size;
  if (least == 0 || size < least || --pieces_left >= 0) return false;
  errno = ENOMEM;
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

/// Notes what was called, for the tests that ask for this kind of notes.
void note(const char* kind, const char* call, const char* path = "", const char* to = "") {
  if (std::strcmp(setting("FAULT_CALL"), kind) != 0) return;
  char line[9000];
  const int size = std::snprintf(line, sizeof line, "%s %s %s\n", call, path, to);
  const int file = open(setting("FAULT_NOTE"), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (file >= 0) syscall(SYS_write, file, line, static_cast<size_t>(size));
  if (file >= 0) close(file);
}

}  // namespace

extern "C" {

void* __libc_malloc(size_t size);                      // NOLINT: glibc's name
void* __libc_memalign(size_t alignment, size_t size);  // NOLINT

void* malloc(size_t size) noexcept { return no_memory(size) ? nullptr : __libc_malloc(size); }

void* aligned_alloc(size_t alignment, size_t size) noexcept {
  return no_memory(size) ? nullptr : __libc_memalign(alignment, size);
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  if (fails("write", Path(descriptor).text)) return -1;
  note("log", "write", Path(descriptor).text);
  return real<ssize_t (*)(int, const void*, size_t)>("write")(descriptor, bytes, size);
}

int fsync(int descriptor) {
  if (fails("fsync", Path(descriptor).text)) return -1;
  note("log", "fsync", Path(descriptor).text);
  return real<int (*)(int)>("fsync")(descriptor);
}

int rename(const char* from, const char* to) noexcept {
  if (fails("rename", to)) return -1;
  note("log", "rename", from, to);
  return real<int (*)(const char*, const char*)>("rename")(from, to);
}

int remove(const char* path) noexcept {
  note("log", "remove", path);
  return real<int (*)(const char*)>("remove")(path);
}

int unlink(const char* path) noexcept {
  note("log", "remove", path);
  return real<int (*)(const char*)>("unlink")(path);
}

int flock(int descriptor, int operation) noexcept {
  if (fails("flock", Path(descriptor).text)) return -1;
  return real<int (*)(int, int)>("flock")(descriptor, operation);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* how, void* (*work)(void*), void* with) noexcept {
  if (begun && fails("pthread_create", "")) return errno;
  return real<int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create")(thread, how, work,
                                                                                                     with);
}

using Main = int (*)(int, char**, char**);
using Hook = void (*)();

int __libc_start_main(Main program, int count, char** words, Hook first, Hook last, Hook linker,
                      void* stack) {  // NOLINT
  begun = true;
  return real<int (*)(Main, int, char**, Hook, Hook, Hook, void*)>("__libc_start_main")(program, count, words, first,
                                                                                        last, linker, stack);
}

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const int result = real<int (*)(clockid_t, timespec*)>("clock_gettime")(clock, now);
  if (result == 0 && clock == CLOCK_REALTIME && jumps()) now->tv_sec += jump();
  return result;
}

time_t time(time_t* now) noexcept {
  const time_t result = real<time_t (*)(time_t*)>("time")(nullptr) + (jumps() ? jump() : 0);
  if (now != nullptr) *now = result;
  return result;
}

int gettimeofday(timeval* now, void* zone) noexcept {
  const int result = real<int (*)(timeval*, void*)>("gettimeofday")(now, zone);
  if (result == 0 && jumps()) now->tv_sec += jump();
  return result;
}

int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const timespec* until) {
  note("clock", "pthread_cond_timedwait");
  return real<int (*)(pthread_cond_t*, pthread_mutex_t*, const timespec*)>("pthread_cond_timedwait")(condition, mutex,
                                                                                                     until);
}

}  // extern "C"
