// locus/io.h
#include <locus/io.h>

#include "io/boundary.hpp"

namespace locus::io {

ErrorText &last_error_text() noexcept {
    thread_local ErrorText text{};
    return text;
}

} // namespace locus::io

const char *locus_io_last_error(void) noexcept { return locus::io::last_error_text().data(); }
