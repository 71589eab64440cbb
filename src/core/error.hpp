// The one exception type that carries a status through the library, and checks that throw it.
#pragma once

#include <locus/status.h>

#include <exception>
#include <sstream>
#include <string>
#include <utility>

namespace locus {

class Error : public std::exception {
public:
    Error(locus_status status, std::string text) : status_(status), text_(std::move(text)) {}
    const char *what() const noexcept override { return text_.c_str(); }
    locus_status status() const noexcept { return status_; }

private:
    locus_status status_;
    std::string text_;
};

// Throw Error(status) with the parts joined into one text.
template <typename... Parts>
[[noreturn]] void fail(locus_status status, const Parts &...parts) {
    std::ostringstream text;
    text.precision(17);
    (text << ... << parts);
    throw Error(status, text.str());
}

// A bad argument: fail(LOCUS_E_ARGUMENT, ...) unless `good`.
template <typename... Parts>
void require(bool good, const Parts &...parts) {
    if (!good)
        fail(LOCUS_E_ARGUMENT, parts...);
}

// A pointer argument that must not be NULL; `name` is the parameter's name in the header.
template <typename T>
T &need(T *pointer, const char *name) {
    require(pointer != nullptr, name, " is NULL");
    return *pointer;
}

} // namespace locus
