// Reading and atomic writing of files by system calls.
#include "io/file.hpp"

#include "core/error.hpp"

#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace locus::io {
namespace {

[[noreturn]] void fail_io(const std::string &path, const char *doing, int code) {
    fail(LOCUS_E_IO, path, ": ", doing, ": ", std::generic_category().message(code));
}

std::string folder_of(const std::string &path) {
    const size_t slash = path.rfind('/');
    if (slash == std::string::npos)
        return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

} // namespace

// O_NONBLOCK: opening a pipe that nobody writes to must not wait for ever.
InputFile::InputFile(const std::string &path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
    if (descriptor_ < 0)
        fail_io(path_, "cannot open", errno);
    struct stat status {};
    const int code = ::fstat(descriptor_, &status) == 0 ? 0 : errno;
    if (code != 0 || !S_ISREG(status.st_mode)) {
        ::close(descriptor_);
        if (code != 0)
            fail_io(path_, "cannot stat", code);
        fail(LOCUS_E_IO, path_, ": not a regular file");
    }
    size_ = static_cast<uint64_t>(status.st_size);
}

InputFile::InputFile(InputFile &&other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

InputFile::~InputFile() {
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

size_t InputFile::read_at(uint64_t offset, std::span<std::byte> target) const {
    size_t done = 0;
    while (done < target.size() && offset + done < size_) {
        const ssize_t got =
            ::pread(descriptor_, target.data() + done, target.size() - done, static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            fail_io(path_, "cannot read", errno);
        if (got == 0)
            break; // it shrank meanwhile
        done += static_cast<size_t>(got);
    }
    return done;
}

AtomicFile::AtomicFile(const std::string &path) : path_(path) {
    static std::atomic<uint64_t> serial{0};
    do {
        temporary_ = path + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(serial++);
        descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0)
        fail_io(temporary_, "cannot create", errno);
}

AtomicFile::~AtomicFile() {
    if (descriptor_ < 0)
        return;
    ::close(descriptor_);
    ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    write_at(size_, bytes);
    size_ += bytes.size();
}

void AtomicFile::overwrite(uint64_t offset, std::span<const std::byte> bytes) { write_at(offset, bytes); }

void AtomicFile::write_at(uint64_t offset, std::span<const std::byte> bytes) {
    for (size_t done = 0; done < bytes.size();) {
        const ssize_t put =
            ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0)
            fail_io(path_, "cannot write", errno);
        done += static_cast<size_t>(put);
    }
}

void AtomicFile::commit() {
    if (::fsync(descriptor_) != 0)
        fail_io(path_, "cannot flush to the disk", errno);
    if (::rename(temporary_.c_str(), path_.c_str()) != 0)
        fail_io(path_, "cannot put in place", errno);
    ::close(std::exchange(descriptor_, -1));
    // The rename itself reaches the disk with the folder; where a file system cannot flush one, nothing is lost but
    // time.
    const int folder = ::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0)
        return;
    ::fsync(folder);
    ::close(folder);
}

} // namespace locus::io
