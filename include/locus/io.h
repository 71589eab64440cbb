/* locus/io.h - what the headers of liblocus_io share; include locus/volume.h for volume files, locus/records.h for
 * records.
 *
 * liblocus_io reads and writes files and is a library of its own (-llocus_io), so that programs which only embed the
 * engines need none of its dependencies; it does not need liblocus either. Statuses are those of locus/status.h, and
 * the same rules hold: no exception, abort, exit or print leaves it, and a call that fails leaves every object as it
 * was. */
#ifndef LOCUS_IO_H
#define LOCUS_IO_H

#include <locus/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What went wrong in the calling thread's latest failed call of liblocus_io, naming the function, the file and the
 * offending value. It is kept apart from locus_last_error(), which speaks for liblocus alone. The text belongs to the
 * thread: it stays valid until that thread's next failed call of liblocus_io or its end, and a successful call leaves
 * it alone. "" when nothing has failed yet. Cannot fail. Any thread. Since 0.1. */
LOCUS_API const char *locus_io_last_error(void) LOCUS_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#endif
