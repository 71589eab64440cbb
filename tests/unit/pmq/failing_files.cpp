// The calls, wrapped by the linker (--wrap).
#include "tests/unit/pmq/failing_files.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace locus::test {
namespace {

std::atomic<bool> armed = false, has_failed = false;
std::atomic<size_t> left = 0; // calls that go well
FailingFiles::Way chosen_way;
int chosen_code;

// Make the call, or what stands for it: `half` where it writes.
template <typename Call, typename Half>
auto perform(Call &&call, Half &&half) -> decltype(call()) {
    if (!armed || left.fetch_sub(1) != 0)
        return call();
    armed = false;
    has_failed = true;
    if (chosen_way == FailingFiles::Way::refused) {
        errno = chosen_code;
        return -1;
    }
    if (chosen_way == FailingFiles::Way::killed_behind)
        half();
    ::raise(SIGKILL);
    return -1;
}
template <typename Call>
auto perform(Call &&call) -> decltype(call()) {
    return perform(call, call);
}

} // namespace

FailingFiles::FailingFiles(size_t after, Way way, int code) noexcept {
    chosen_way = way;
    chosen_code = code;
    left = after;
    has_failed = false;
    armed = true;
}
FailingFiles::~FailingFiles() { armed = false; }
bool FailingFiles::failed() const noexcept { return has_failed; }

} // namespace locus::test

using locus::test::perform;

extern "C" { // the linker's names
int __real_open(const char *path, int flags, ...);
ssize_t __real_pread(int file, void *bytes, size_t count, off_t offset);
ssize_t __real_pwrite(int file, const void *bytes, size_t count, off_t offset);
int __real_fsync(int file);
int __real_fdatasync(int file);
int __real_ftruncate(int file, off_t length);
int __real_rename(const char *from, const char *to);
int __real_unlink(const char *path);
int __real_mkdir(const char *path, mode_t mode);

int __wrap_open(const char *path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return perform([&] { return __real_open(path, flags, mode); });
}
ssize_t __wrap_pread(int file, void *bytes, size_t count, off_t offset) {
    return perform([&] { return __real_pread(file, bytes, count, offset); });
}
ssize_t __wrap_pwrite(int file, const void *bytes, size_t count, off_t offset) {
    return perform([&] { return __real_pwrite(file, bytes, count, offset); },
                   [&] { return __real_pwrite(file, bytes, count / 2, offset); });
}
int __wrap_fsync(int file) {
    return perform([&] { return __real_fsync(file); });
}
int __wrap_fdatasync(int file) {
    return perform([&] { return __real_fdatasync(file); });
}
int __wrap_ftruncate(int file, off_t length) {
    return perform([&] { return __real_ftruncate(file, length); });
}
int __wrap_rename(const char *from, const char *to) {
    return perform([&] { return __real_rename(from, to); });
}
int __wrap_unlink(const char *path) {
    return perform([&] { return __real_unlink(path); });
}
int __wrap_mkdir(const char *path, mode_t mode) {
    return perform([&] { return __real_mkdir(path, mode); });
}
}
