// Reading and decompressing.
#include "io/byte_source.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

namespace locus::io {

constexpr size_t raw_size = size_t{1} << 17;

Descriptor::~Descriptor() {
    if (owned_)
        ::close(fd_);
}

void ByteSource::FreeDecoder::operator()(ZSTD_DCtx_s *decoder) const { ZSTD_freeDCtx(decoder); }

ByteSource ByteSource::open(const std::string &path) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        fail(LOCUS_E_IO, "cannot open ", path, ": ", std::strerror(errno));
    return {Descriptor(fd, true), path};
}

ByteSource::ByteSource(Descriptor fd, std::string name) : fd_(std::move(fd)), name_(std::move(name)), raw_(raw_size) {
    struct stat status {};
    if (fstat(fd_.get(), &status) != 0)
        fail(LOCUS_E_IO, "cannot read ", name_, ": ", std::strerror(errno));
    if (S_ISDIR(status.st_mode))
        fail(LOCUS_E_IO, "cannot read ", name_, ": it is a folder");
    regular_ = S_ISREG(status.st_mode);
    if (regular_)
        size_ = static_cast<uint64_t>(status.st_size);
}

// Read into the free end of raw_, after moving what is unused to its front.
void ByteSource::refill() {
    std::copy(raw_.begin() + static_cast<std::ptrdiff_t>(next_), raw_.begin() + static_cast<std::ptrdiff_t>(last_),
              raw_.begin());
    last_ -= next_;
    next_ = 0;
    ssize_t got = 0;
    do {
        got = ::read(fd_.get(), raw_.data() + last_, raw_.size() - last_);
    } while (got < 0 && errno == EINTR);
    if (got < 0)
        fail(LOCUS_E_IO, "cannot read ", name_, ": ", std::strerror(errno));
    end_ = got == 0;
    last_ += static_cast<size_t>(got);
    bytes_read_ += static_cast<uint64_t>(got);
}

// The first bytes tell a compressed stream (RFC 8878, RFC 1952).
void ByteSource::detect() {
    while (!end_ && last_ - next_ < 4)
        refill();
    begun_ = true;
    const std::string_view head(raw_.data() + next_, std::min<size_t>(last_ - next_, 4));
    if (head.starts_with("\x1f\x8b"))
        fail(LOCUS_E_FORMAT, name_, " is gzip-compressed: unpack it first (zstd is read directly)");
    const bool skippable = head.size() == 4 && (head[0] & 0xf0) == 0x50 && head.substr(1) == "\x2a\x4d\x18";
    if (!skippable && !head.starts_with("\x28\xb5\x2f\xfd"))
        return;
    decoder_.reset(ZSTD_createDCtx());
    if (!decoder_)
        throw std::bad_alloc();
}

size_t ByteSource::read(char *into, size_t capacity) {
    if (!begun_)
        detect();
    if (decoder_)
        return decompress(into, capacity);
    if (next_ == last_ && !end_)
        refill();
    const size_t count = std::min(capacity, last_ - next_);
    std::memcpy(into, raw_.data() + next_, count);
    next_ += count;
    return count;
}

size_t ByteSource::decompress(char *into, size_t capacity) {
    ZSTD_outBuffer out{into, capacity, 0};
    while (out.pos == 0) {
        if (next_ == last_ && !end_)
            refill();
        if (next_ == last_ && end_ && !frame_open_)
            return 0;
        ZSTD_inBuffer in{raw_.data() + next_, last_ - next_, 0};
        const size_t left = ZSTD_decompressStream(decoder_.get(), &out, &in);
        if (ZSTD_isError(left) != 0)
            fail(LOCUS_E_FORMAT, name_, " is not a whole zstd stream: ", ZSTD_getErrorName(left));
        next_ += in.pos;
        frame_open_ = left != 0;
        if (frame_open_ && out.pos == 0 && next_ == last_ && end_)
            fail(LOCUS_E_FORMAT, name_, " is not a whole zstd stream: it ends inside a frame");
    }
    return out.pos;
}

bool ByteSource::ready() const {
    if (regular_ || end_ || next_ != last_)
        return true;
    pollfd wait{fd_.get(), POLLIN, 0};
    return poll(&wait, 1, 0) != 0;
}

} // namespace locus::io
