// Streams of bytes out of and into files, through zlib where they are compressed.
#pragma once

#include "core/file.hpp"

#include <memory>
#include <vector>

#include <zlib.h>

namespace locus::io {

// The bytes of a file from an offset on, inflated (zlib or gzip, told apart by their first bytes) or as they are.
class ByteReader {
public:
    ByteReader(const InputFile &file, uint64_t offset, bool deflated);
    ByteReader(const ByteReader &) = delete;
    ByteReader &operator=(const ByteReader &) = delete;
    ~ByteReader();

    // Read up to target.size() bytes; fewer only at the end.
    size_t read(std::span<std::byte> target);
    // Pass over up to `count` bytes; returns how many there were.
    uint64_t skip(uint64_t count);

    // The compressed stream ended before its end mark and checksum.
    bool broken_off() const { return broken_off_; }

private:
    size_t inflate_into(std::span<std::byte> target);

    const InputFile &file_;
    uint64_t offset_;
    bool deflated_;
    bool ended_ = false;
    bool broken_off_ = false;
    z_stream stream_{};
    std::vector<std::byte> input_;
};

// Where written bytes go: straight into the file, or deflated into it.
class ByteWriter {
public:
    enum class Wrap { none, zlib, gzip };
    ByteWriter(AtomicFile &file, Wrap wrap, int level);
    ByteWriter(const ByteWriter &) = delete;
    ByteWriter &operator=(const ByteWriter &) = delete;
    ~ByteWriter();

    void write(std::span<const std::byte> bytes);
    void finish(); // after the last write
private:
    void deflate_some(std::span<const std::byte> bytes, int flush);

    AtomicFile &file_;
    Wrap wrap_;
    z_stream stream_{};
    std::vector<std::byte> output_;
};

} // namespace locus::io
