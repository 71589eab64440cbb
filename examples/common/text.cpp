// Text on a canvas, in two bitmap fonts.
#include "common/canvas.hpp"

#include <algorithm>
#include <iterator>

namespace demo {
namespace {

template <typename Row, size_t height>
struct Glyph {
    uint16_t code;
    Row rows[height];
};

#include "common/glyphs.inc"

// The next code point of a UTF-8 text, taken off its front; a broken sequence counts as one '?'.
uint32_t next_code(std::string_view &text) {
    const auto byte = [&](size_t i) { return static_cast<uint8_t>(text[i]); };
    const uint8_t lead = byte(0);
    const size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    uint32_t code = length == 1 ? lead : lead & (0xffu >> (length + 1));
    const size_t available = std::min(length, text.size());
    size_t used = 1;
    for (; used < available && (byte(used) & 0xc0) == 0x80; ++used)
        code = code << 6 | (byte(used) & 0x3fu);
    text.remove_prefix(used);
    return used == length ? code : '?';
}

template <typename Glyphs>
const auto &glyph_of(const Glyphs &font, uint32_t code) {
    if (code == 0x2018 || code == 0x2019)
        code = 0x27; // the typographic apostrophe, as in place names
    const auto found = std::lower_bound(std::begin(font), std::end(font), code,
                                        [](const auto &glyph, uint32_t wanted) { return glyph.code < wanted; });
    return found != std::end(font) && found->code == code ? *found : font['?' - ' '];
}

template <typename Glyphs>
void draw(Canvas &canvas, const Glyphs &font, int x, int y, std::string_view text, Colour colour) {
    constexpr int bits = 8 * sizeof(font[0].rows[0]);
    const int advance = bits == 8 ? 8 : 12;
    for (; !text.empty(); x += advance) {
        int top = y;
        for (const auto row : glyph_of(font, next_code(text)).rows) {
            for (int bit = 0; bit < bits; ++bit)
                if (row >> (bits - 1 - bit) & 1)
                    canvas.set(x + bit, top, colour);
            ++top;
        }
    }
}

} // namespace

void Canvas::text(int x, int y, std::string_view utf8, Colour colour, Font font) {
    font == Font::small ? draw(*this, small_font, x, y, utf8, colour) : draw(*this, large_font, x, y, utf8, colour);
}

int Canvas::text_width(std::string_view utf8, Font font) {
    int letters = 0;
    for (; !utf8.empty(); ++letters)
        next_code(utf8);
    return letters * (font == Font::small ? 8 : 12);
}

int Canvas::text_height(Font font) { return font == Font::small ? 16 : 24; }

} // namespace demo
