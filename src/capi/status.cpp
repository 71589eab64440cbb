// locus/status.h
#include "capi/boundary.hpp"

namespace locus {

ErrorText &last_error_text() noexcept {
    thread_local ErrorText text{};
    return text;
}

} // namespace locus

#define LOCUS_TEXT_OF(number) #number
#define LOCUS_TEXT(number) LOCUS_TEXT_OF(number)

uint32_t locus_version(void) noexcept { return LOCUS_VERSION; }

const char *locus_version_text(void) noexcept {
    return LOCUS_TEXT(LOCUS_VERSION_MAJOR) "." LOCUS_TEXT(LOCUS_VERSION_MINOR) "." LOCUS_TEXT(LOCUS_VERSION_PATCH)
#ifdef LOCUS_SIMD_SCALAR_ONLY
        " simd=scalar"
#else
        " simd=highway"
#endif
#ifdef LOCUS_WITH_CUDA
        " cuda=yes";
#else
        " cuda=no";
#endif
}

const char *locus_status_name(locus_status status) noexcept {
    switch (status) {
#define LOCUS_NAME(constant)                                                                                           \
    case constant:                                                                                                     \
        return #constant
        LOCUS_NAME(LOCUS_OK);
        LOCUS_NAME(LOCUS_E_ARGUMENT);
        LOCUS_NAME(LOCUS_E_RANGE);
        LOCUS_NAME(LOCUS_E_CAPACITY);
        LOCUS_NAME(LOCUS_E_STATE);
        LOCUS_NAME(LOCUS_E_UNSUPPORTED);
        LOCUS_NAME(LOCUS_E_STOPPED);
        LOCUS_NAME(LOCUS_E_BUSY);
        LOCUS_NAME(LOCUS_E_STALE);
        LOCUS_NAME(LOCUS_E_MEMORY);
        LOCUS_NAME(LOCUS_E_IO);
        LOCUS_NAME(LOCUS_E_FORMAT);
        LOCUS_NAME(LOCUS_E_DEVICE);
        LOCUS_NAME(LOCUS_E_INTERNAL);
#undef LOCUS_NAME
    default:
        return "LOCUS_E_UNKNOWN";
    }
}

const char *locus_last_error(void) noexcept { return locus::last_error_text().data(); }
