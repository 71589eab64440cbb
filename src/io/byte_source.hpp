// Bytes from a file or a pipe, decompressed where they are a zstd stream.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct ZSTD_DCtx_s;

namespace locus::io {

// A descriptor that is closed at the end, if it is owned.
class Descriptor {
public:
    Descriptor(int fd, bool owned) : fd_(fd), owned_(owned) {}
    Descriptor(Descriptor &&other) noexcept : fd_(other.fd_), owned_(other.owned_) { other.owned_ = false; }
    Descriptor(const Descriptor &) = delete;
    Descriptor &operator=(const Descriptor &) = delete;
    ~Descriptor();
    int get() const { return fd_; }

private:
    int fd_;
    bool owned_;
};

class ByteSource {
public:
    // Open `path` for reading; throws LOCUS_E_IO with the path and the system's reason.
    static ByteSource open(const std::string &path);
    ByteSource(Descriptor fd, std::string name);

    // Store up to `capacity` bytes; 0: the end. Throws LOCUS_E_IO or LOCUS_E_FORMAT.
    size_t read(char *into, size_t capacity);

    // False: a read would wait for a pipe.
    bool ready() const;

    const std::string &name() const { return name_; }
    uint64_t bytes_read() const { return bytes_read_; }
    uint64_t size() const { return size_; } // 0: unknown

private:
    void refill();
    void detect();
    size_t decompress(char *into, size_t capacity);

    struct FreeDecoder {
        void operator()(ZSTD_DCtx_s *decoder) const;
    };

    Descriptor fd_;
    std::string name_;
    bool regular_ = false;
    bool begun_ = false;
    bool end_ = false;        // the descriptor has no more
    bool frame_open_ = false; // inside a zstd frame
    uint64_t bytes_read_ = 0;
    uint64_t size_ = 0;
    std::vector<char> raw_; // bytes of the descriptor; raw_[next_, last_) are unused yet
    size_t next_ = 0;
    size_t last_ = 0;
    std::unique_ptr<ZSTD_DCtx_s, FreeDecoder> decoder_; // null: not compressed
};

} // namespace locus::io
