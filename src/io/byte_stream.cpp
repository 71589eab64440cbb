// zlib on the way in and out.
#include "io/byte_stream.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <array>
#include <climits>
#include <new>

namespace locus::io {
namespace {

constexpr size_t buffer_bytes = size_t{1} << 17;
constexpr int window_bits = 15;
constexpr int detect_header = 32; // added to the window bits: zlib or gzip
constexpr int gzip_header = 16;   // added to the window bits: gzip

// zlib counts in 32 bits.
uInt chunk(size_t bytes) { return static_cast<uInt>(std::min<size_t>(bytes, INT_MAX)); }

Bytef *zbytes(const std::byte *bytes) { return reinterpret_cast<Bytef *>(const_cast<std::byte *>(bytes)); }

} // namespace

ByteReader::ByteReader(const InputFile &file, uint64_t offset, bool deflated)
    : file_(file), offset_(offset), deflated_(deflated) {
    if (!deflated_)
        return;
    input_.resize(buffer_bytes);
    if (inflateInit2(&stream_, window_bits + detect_header) != Z_OK)
        throw std::bad_alloc();
}

ByteReader::~ByteReader() {
    if (deflated_)
        inflateEnd(&stream_);
}

size_t ByteReader::read(std::span<std::byte> target) {
    if (!deflated_) {
        const size_t got = file_.read_at(offset_, target);
        offset_ += got;
        return got;
    }
    size_t done = 0;
    while (done < target.size() && !ended_)
        done += inflate_into(target.subspan(done));
    return done;
}

size_t ByteReader::inflate_into(std::span<std::byte> target) {
    if (stream_.avail_in == 0) {
        const size_t got = file_.read_at(offset_, input_);
        offset_ += got;
        stream_.next_in = zbytes(input_.data());
        stream_.avail_in = chunk(got);
        if (got == 0) {
            ended_ = broken_off_ = true;
            return 0;
        }
    }
    stream_.next_out = zbytes(target.data());
    stream_.avail_out = chunk(target.size());
    const uInt room = stream_.avail_out;
    const int result = inflate(&stream_, Z_NO_FLUSH);
    if (result == Z_MEM_ERROR)
        throw std::bad_alloc();
    if (result == Z_STREAM_END) {
        // A gzip file may hold several streams in a row. Whatever else follows is not ours.
        std::array<std::byte, 2> next{};
        const uint64_t place = offset_ - stream_.avail_in;
        const bool more = file_.read_at(place, next) == 2 && next[0] == std::byte{0x1f} && next[1] == std::byte{0x8b};
        const size_t given = room - stream_.avail_out;
        if (more) {
            offset_ = place;
            stream_.avail_in = 0;
            inflateReset(&stream_);
        }
        ended_ = !more;
        return given;
    }
    if (result != Z_OK && result != Z_BUF_ERROR)
        fail(LOCUS_E_FORMAT, file_.path(), ": the compressed data are damaged (",
             stream_.msg != nullptr ? stream_.msg : "zlib refuses them", ")");
    return room - stream_.avail_out;
}

uint64_t ByteReader::skip(uint64_t count) {
    if (!deflated_) {
        const uint64_t there = file_.size() > offset_ ? file_.size() - offset_ : 0;
        const uint64_t passed = std::min(count, there);
        offset_ += passed;
        return passed;
    }
    std::vector<std::byte> sink(static_cast<size_t>(std::min<uint64_t>(count, buffer_bytes)));
    uint64_t passed = 0;
    while (passed < count) {
        const size_t want = static_cast<size_t>(std::min<uint64_t>(sink.size(), count - passed));
        const size_t got = read(std::span(sink).first(want));
        passed += got;
        if (got < want)
            break;
    }
    return passed;
}

ByteWriter::ByteWriter(AtomicFile &file, Wrap wrap, int level) : file_(file), wrap_(wrap) {
    if (wrap_ == Wrap::none)
        return;
    output_.resize(buffer_bytes);
    const int bits = window_bits + (wrap_ == Wrap::gzip ? gzip_header : 0);
    constexpr int memory_level = 8; // zlib's default
    if (deflateInit2(&stream_, level, Z_DEFLATED, bits, memory_level, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
}

ByteWriter::~ByteWriter() {
    if (wrap_ != Wrap::none)
        deflateEnd(&stream_);
}

void ByteWriter::write(std::span<const std::byte> bytes) {
    if (wrap_ == Wrap::none)
        return file_.write(bytes);
    while (!bytes.empty()) {
        const auto part = bytes.first(chunk(bytes.size()));
        deflate_some(part, Z_NO_FLUSH);
        bytes = bytes.subspan(part.size());
    }
}

void ByteWriter::finish() {
    if (wrap_ != Wrap::none)
        deflate_some({}, Z_FINISH);
}

void ByteWriter::deflate_some(std::span<const std::byte> bytes, int flush) {
    stream_.next_in = zbytes(bytes.data());
    stream_.avail_in = static_cast<uInt>(bytes.size());
    do {
        stream_.next_out = zbytes(output_.data());
        stream_.avail_out = chunk(output_.size());
        deflate(&stream_, flush);
        file_.write(std::span(output_).first(output_.size() - stream_.avail_out));
    } while (stream_.avail_out == 0);
}

} // namespace locus::io
