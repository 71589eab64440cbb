// Files: a regular file open for reading, one that appears under its name only when it is whole, and what both
// libraries need of the operating system. In a header, because liblocus_io does not need liblocus.
#pragma once

#include "core/error.hpp"

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <span>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace locus {

[[noreturn]] inline void fail_io(const std::string &path, const std::string &doing, int code) {
    fail(LOCUS_E_IO, path, ": ", doing, ": ", std::generic_category().message(code));
}

inline std::string folder_of(const std::string &path) {
    const size_t slash = path.rfind('/');
    if (slash == std::string::npos)
        return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

// An open file's number, closed at the end.
class Descriptor {
public:
    explicit Descriptor(int number = -1) noexcept : number_(number) {}
    Descriptor(Descriptor &&other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor &operator=(Descriptor &&other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor() { close(); }
    int number() const noexcept { return number_; }
    bool open() const noexcept { return number_ >= 0; }
    void close() noexcept {
        if (number_ >= 0)
            ::close(std::exchange(number_, -1));
    }

private:
    int number_;
};

// The entries of a folder reach the disk. Where a file system cannot flush one, nothing is lost but time.
inline void flush_folder(const std::string &folder) noexcept {
    const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (descriptor.open())
        ::fsync(descriptor.number());
}

inline void write_at(const Descriptor &file, const std::string &path, uint64_t offset,
                     std::span<const std::byte> bytes) {
    for (size_t done = 0; done < bytes.size();) {
        const ssize_t put =
            ::pwrite(file.number(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0)
            fail_io(path, "cannot write at byte " + std::to_string(offset + done), errno);
        done += static_cast<size_t>(put);
    }
}

// A regular file open for reading. Every failure is LOCUS_E_IO and names the path.
class InputFile {
public:
    // O_NONBLOCK: opening a pipe that nobody writes to must not wait for ever.
    explicit InputFile(const std::string &path)
        : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
        if (!file_.open())
            fail_io(path_, "cannot open", errno);
        struct stat status {};
        if (::fstat(file_.number(), &status) != 0)
            fail_io(path_, "cannot stat", errno);
        if (!S_ISREG(status.st_mode))
            fail(LOCUS_E_IO, path_, ": not a regular file");
        size_ = static_cast<uint64_t>(status.st_size);
    }

    const std::string &path() const { return path_; }
    uint64_t size() const { return size_; }
    // It will be read from the beginning to the end.
    void expect_sequence() const noexcept { ::posix_fadvise(file_.number(), 0, 0, POSIX_FADV_SEQUENTIAL); }
    // These bytes will be read soon: the disk may begin.
    void expect(uint64_t offset, uint64_t bytes) const noexcept {
        ::posix_fadvise(file_.number(), static_cast<off_t>(offset), static_cast<off_t>(bytes), POSIX_FADV_WILLNEED);
    }
    // Read up to target.size() bytes from `offset` on; fewer only at the end of the file.
    size_t read_at(uint64_t offset, std::span<std::byte> target) const {
        size_t done = 0;
        while (done < target.size() && offset + done < size_) {
            const ssize_t got =
                ::pread(file_.number(), target.data() + done, target.size() - done, static_cast<off_t>(offset + done));
            if (got < 0 && errno == EINTR)
                continue;
            if (got < 0)
                fail_io(path_, "cannot read at byte " + std::to_string(offset + done), errno);
            if (got == 0)
                break; // it shrank meanwhile
            done += static_cast<size_t>(got);
        }
        return done;
    }

private:
    std::string path_;
    Descriptor file_;
    uint64_t size_ = 0;
};

// A file that is written under a temporary name beside `path` and renamed to it by commit(); without one, it vanishes.
class AtomicFile {
public:
    explicit AtomicFile(const std::string &path) : path_(path) {
        static std::atomic<uint64_t> serial{0};
        do {
            temporary_ = path + infix + std::to_string(::getpid()) + "-" + std::to_string(serial++);
            file_ = Descriptor(::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        } while (!file_.open() && errno == EEXIST);
        if (!file_.open())
            fail_io(temporary_, "cannot create", errno);
    }
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;
    ~AtomicFile() {
        if (file_.open())
            ::unlink(temporary_.c_str());
    }

    static constexpr const char *infix = ".part-"; // behind it: what makes the temporary name unique

    void write(std::span<const std::byte> bytes) { // behind what was written last
        write_at(file_, path_, size_, bytes);
        size_ += bytes.size();
        start_flush();
    }
    void overwrite(uint64_t offset, std::span<const std::byte> bytes) { write_at(file_, path_, offset, bytes); }
    uint64_t size() const { return size_; }
    void commit() { // flush to the disk and rename
        const std::string folder = folder_of(path_);
        if (::fsync(file_.number()) != 0)
            fail_io(path_, "cannot flush to the disk", errno);
        if (::rename(temporary_.c_str(), path_.c_str()) != 0)
            fail_io(path_, "cannot put in place", errno);
        file_.close();
        flush_folder(folder);
    }

private:
    // The disk works while the rest is still being made.
    void start_flush() noexcept {
#ifdef SYNC_FILE_RANGE_WRITE
        constexpr uint64_t step = 8 << 20;
        if (size_ - flushed_ < step)
            return;
        ::sync_file_range(file_.number(), static_cast<off_t>(flushed_), static_cast<off_t>(size_ - flushed_),
                          SYNC_FILE_RANGE_WRITE);
        flushed_ = size_;
#endif
    }

    std::string path_;
    std::string temporary_;
    Descriptor file_;
    uint64_t size_ = 0;
    [[maybe_unused]] uint64_t flushed_ = 0;
};

} // namespace locus
