/* locus/io.hpp - what the C++ headers of liblocus_io share; include locus/volume.hpp or locus/records.hpp. */
#ifndef LOCUS_IO_HPP
#define LOCUS_IO_HPP

#include <locus/io.h>
#include <locus/status.hpp>

namespace locus {
namespace detail {
/* liblocus_io keeps its error texts apart. */
inline bool settle_io(locus_status code, status *result) { return settle(code, result, locus_io_last_error()); }
} // namespace detail
} // namespace locus
#endif
