// The boundary of liblocus_cold: every exported call that can fail runs its body in here.
#pragma once

#include "core/barrier.hpp"

#include <utility>

namespace locus::cold {

// The calling thread's text for locus_cold_last_error().
ErrorText &last_error_text() noexcept;

// Run `body` and turn an exception into a status and an error text.
template <std::invocable Body>
locus_status boundary(const char *function, Body &&body) noexcept {
    return barrier(function, last_error_text, std::forward<Body>(body));
}

} // namespace locus::cold
