#include "cold/lock_file.hpp"

#include "core/error.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace locus::cold {

LockFile::LockFile(std::string path) : path_(std::move(path)) {
    while (!take()) { // it was removed by its former holder in between
    }
}

LockFile::~LockFile() {
    unlink(path_.c_str());
    close(descriptor_);
}

bool LockFile::take() {
    const auto cannot = [this](const char *what) {
        const int reason = errno;
        if (descriptor_ >= 0)
            close(descriptor_);
        fail(LOCUS_E_IO, path_, ": ", what, ": ", std::strerror(reason));
    };
    descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor_ < 0)
        cannot("cannot be made");
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        if (errno != EWOULDBLOCK)
            cannot("cannot be locked");
        close(descriptor_);
        fail(LOCUS_E_BUSY, path_, ": the database is open already");
    }
    struct stat held, there;
    if (fstat(descriptor_, &held) == 0 && stat(path_.c_str(), &there) == 0 && held.st_ino == there.st_ino &&
        held.st_dev == there.st_dev)
        return true;
    close(descriptor_);
    return false;
}

} // namespace locus::cold
