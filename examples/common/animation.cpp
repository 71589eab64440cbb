// APNG: the PNG specification, third edition, section 11.3.6.
#include "common/animation.hpp"

#include <stdexcept>
#include <string_view>
#include <zlib.h>

namespace demo {
namespace {

constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";

uint32_t get32(const uint8_t *bytes) {
    return uint32_t{bytes[0]} << 24 | uint32_t{bytes[1]} << 16 | uint32_t{bytes[2]} << 8 | uint32_t{bytes[3]};
}

// PNG's numbers are big-endian.
std::string bytes32(uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
            static_cast<char>(value)};
}
std::string bytes16(uint16_t value) { return {static_cast<char>(value >> 8), static_cast<char>(value)}; }

// A chunk: length, type, data, checksum of type and data.
std::string chunk(std::string_view type, std::string_view data) {
    const std::string body = std::string(type) + std::string(data);
    const auto *bytes = reinterpret_cast<const Bytef *>(body.data());
    return bytes32(static_cast<uint32_t>(data.size())) + body +
           bytes32(static_cast<uint32_t>(crc32(0, bytes, static_cast<uInt>(body.size()))));
}

} // namespace

void Animation::add(const std::vector<uint8_t> &png) {
    std::string header, palette, image;
    for (size_t at = signature.size(); at + 12 <= png.size();) {
        const uint32_t length = get32(&png[at]);
        const std::string_view type(reinterpret_cast<const char *>(&png[at + 4]), 4);
        const std::string_view data(reinterpret_cast<const char *>(png.data()) + at + 8, length);
        if (type == "IHDR")
            header = data;
        if (type == "PLTE")
            palette = data;
        if (type == "IDAT")
            image += data;
        at += 12 + size_t{length};
    }
    if (!frames_.empty() && (header != header_ || palette != palette_))
        throw std::runtime_error("the frames of an animation differ in size or palette");
    header_ = header;
    palette_ = palette;
    frames_.push_back(std::move(image));
}

void Animation::write(const std::string &path, uint16_t milliseconds) const {
    if (frames_.empty())
        throw std::runtime_error("cannot write " + path + ": an animation needs a frame");
    std::string file(signature);
    file += chunk("IHDR", header_);
    file += chunk("acTL", bytes32(static_cast<uint32_t>(frames_.size())) + bytes32(0)); // over and over
    if (!palette_.empty())
        file += chunk("PLTE", palette_);
    uint32_t sequence = 0;
    for (size_t i = 0; i < frames_.size(); ++i) {
        const bool last = i + 1 == frames_.size();
        const std::string size = header_.substr(0, 8); // width and height
        const std::string place = bytes32(0) + bytes32(0);
        const std::string delay = bytes16(last ? 2000 : milliseconds) + bytes16(1000); // parts of a second
        const std::string plain = bytes16(0); // neither disposed of nor blended
        file += chunk("fcTL", bytes32(sequence++) + size + place + delay + plain);
        file += i == 0 ? chunk("IDAT", frames_[i]) : chunk("fdAT", bytes32(sequence++) + frames_[i]);
    }
    file += chunk("IEND", "");
    write_file(path, file.data(), file.size());
}

} // namespace demo
