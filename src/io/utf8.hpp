// UTF-8 from outside: whole characters only.
#pragma once

#include <string>
#include <string_view>

namespace locus::io {

bool valid_utf8(std::string_view text);

// `text` with U+FFFD for every byte that is not part of a valid character.
std::string repaired_utf8(std::string_view text);

// The longest beginning of a valid text that holds whole characters and at most `size` bytes.
std::string_view cut_utf8(std::string_view text, size_t size);

// A short beginning of any bytes for an error text: printable, and marked where it was cut.
std::string excerpt(std::string_view bytes);

} // namespace locus::io
