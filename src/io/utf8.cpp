// Well-formed byte sequences: the Unicode Standard, table 3-7.
#include "io/utf8.hpp"

#include <algorithm>
#include <cstdint>

namespace locus::io {
namespace {

// The length of the valid character at the front; 0: there is none.
size_t character(std::string_view text) {
    const auto byte = [&](size_t i) -> unsigned { return i < text.size() ? static_cast<uint8_t>(text[i]) : 0u; };
    const auto in = [](unsigned value, unsigned low, unsigned high) { return low <= value && value <= high; };
    const auto follows = [&](size_t i) { return in(byte(i), 0x80, 0xbf); };
    const unsigned lead = byte(0);
    if (lead < 0x80)
        return 1;
    if (in(lead, 0xc2, 0xdf))
        return follows(1) ? 2 : 0;
    if (in(lead, 0xe0, 0xef)) {
        const bool second = in(byte(1), lead == 0xe0 ? 0xa0 : 0x80, lead == 0xed ? 0x9f : 0xbf);
        return second && follows(2) ? 3 : 0;
    }
    if (in(lead, 0xf0, 0xf4)) {
        const bool second = in(byte(1), lead == 0xf0 ? 0x90 : 0x80, lead == 0xf4 ? 0x8f : 0xbf);
        return second && follows(2) && follows(3) ? 4 : 0;
    }
    return 0;
}

} // namespace

bool valid_utf8(std::string_view text) {
    while (!text.empty()) {
        const size_t length = character(text);
        if (length == 0)
            return false;
        text.remove_prefix(length);
    }
    return true;
}

std::string repaired_utf8(std::string_view text) {
    std::string whole;
    while (!text.empty()) {
        const size_t length = character(text);
        whole += length == 0 ? std::string_view("\xef\xbf\xbd") : text.substr(0, length);
        text.remove_prefix(std::max<size_t>(length, 1));
    }
    return whole;
}

std::string_view cut_utf8(std::string_view text, size_t size) {
    if (text.size() <= size)
        return text;
    while (size > 0 && (text[size] & 0xc0) == 0x80)
        --size;
    return text.substr(0, size);
}

std::string excerpt(std::string_view bytes) {
    constexpr size_t longest = 40;
    std::string text = repaired_utf8(bytes.substr(0, longest + 3));
    if (text.size() > longest)
        text = std::string(cut_utf8(text, longest)) + "...";
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<uint8_t>(c) < ' ' || c == 0x7f; }, ' ');
    return text;
}

} // namespace locus::io
