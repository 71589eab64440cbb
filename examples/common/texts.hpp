// Short posts in many languages, made of templates and place names.
#pragma once

#include "common/random.hpp"

#include <cstddef>
#include <string_view>

namespace demo {

constexpr size_t event_kinds = 6;
std::string_view event_kind_name(size_t kind); // "concert", ...

// Write an everyday post from `country` about `place` at a local hour (0..23) into `text` (`size` bytes, filled up with
// NUL), cut at a character.
void write_post(char *text, size_t size, std::string_view country, std::string_view place, int hour, Random &random);

// The same about an event of that kind.
void write_event_post(char *text, size_t size, std::string_view country, std::string_view place, size_t kind,
                      Random &random);

} // namespace demo
