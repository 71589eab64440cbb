// The exception barrier that every library of Locus puts around its exported calls, with its own thread's error text.
#pragma once

#include "core/error.hpp"

#include <array>
#include <concepts>
#include <cstdio>
#include <new>
#include <type_traits>

namespace locus {

// Fixed storage: keeping the text of an out-of-memory error must not need memory.
using ErrorText = std::array<char, 1024>;

// The status of the exception that is being handled; stores its text, led by the function's name, in `text`.
inline locus_status status_of_current_exception(const char *function, ErrorText &text) noexcept {
    const auto keep = [&](const char *what) { std::snprintf(text.data(), text.size(), "%s: %s", function, what); };
    try {
        throw;
    } catch (const Error &error) {
        keep(error.what());
        return error.status();
    } catch (const std::bad_alloc &) {
        keep("out of memory");
        return LOCUS_E_MEMORY;
    } catch (const std::exception &error) {
        keep(error.what());
        return LOCUS_E_INTERNAL;
    } catch (...) {
        keep("unknown exception");
        return LOCUS_E_INTERNAL;
    }
}

// Run `body`; no exception leaves. `text` gives the calling thread's error text.
template <std::invocable Body>
locus_status barrier(const char *function, ErrorText &(*text)() noexcept, Body &&body) noexcept {
    static_assert(std::is_void_v<std::invoke_result_t<Body>>, "a status would be lost: throw Error");
    try {
        body();
        return LOCUS_OK;
    } catch (...) {
        return status_of_current_exception(function, text());
    }
}

} // namespace locus
