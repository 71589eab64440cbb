// An animated PNG (APNG), as browsers play it.
#pragma once

#include "common/canvas.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace demo {

class Animation {
public:
    // Add a frame, given as a PNG file's bytes. All frames have the same size, and the same palette if any.
    void add(const std::vector<uint8_t> &png);

    // Write the file, every frame shown for `milliseconds`, the last one for two seconds, over and over. Throws
    // std::runtime_error.
    void write(const std::string &path, uint16_t milliseconds) const;

    size_t frames() const { return frames_.size(); }

private:
    std::string header_;              // the data of IHDR,
    std::string palette_;             // and of PLTE; empty: none
    std::vector<std::string> frames_; // the data of each frame's IDAT chunks
};

} // namespace demo
