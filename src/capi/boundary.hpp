// The exception barrier: the one place where exceptions become statuses and error texts.
#pragma once

#include "core/error.hpp"

#include <concepts>
#include <type_traits>

namespace locus {

// The status of the exception that is being handled; keeps its text, led by the function's name, for locus_last_error().
locus_status status_of_current_exception(const char *function) noexcept;

// Run `body`, which returns nothing or a status; no exception leaves. Every exported call that can fail is one of these.
template <std::invocable Body>
locus_status boundary(const char *function, Body &&body) noexcept {
    try {
        if constexpr (std::is_void_v<std::invoke_result_t<Body>>) {
            body();
            return LOCUS_OK;
        } else {
            return body();
        }
    } catch (...) {
        return status_of_current_exception(function);
    }
}

} // namespace locus
