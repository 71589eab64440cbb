/* locus/status.h - status codes, error text, version and log callback.
 *
 * Every call that can fail returns a locus_status: LOCUS_OK (0) on success, one of the LOCUS_E_ constants otherwise.
 * The numbers never change; new ones may be added, so treat an unknown one as a failure.
 * A call that fails on its arguments, on memory or on I/O leaves every object as it was. */
#ifndef LOCUS_STATUS_H
#define LOCUS_STATUS_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define LOCUS_API __attribute__((visibility("default")))
#else
#define LOCUS_API
#endif
#ifdef __cplusplus
#define LOCUS_NOEXCEPT noexcept
extern "C" {
#else
#define LOCUS_NOEXCEPT
#endif

/* The version of these headers. The ABI grows with the minor number and breaks only with the major one. */
#define LOCUS_VERSION_MAJOR 0
#define LOCUS_VERSION_MINOR 1
#define LOCUS_VERSION_PATCH 0
#define LOCUS_VERSION (LOCUS_VERSION_MAJOR * 10000 + LOCUS_VERSION_MINOR * 100 + LOCUS_VERSION_PATCH)

typedef int32_t locus_status;

#define LOCUS_OK 0
/* The caller's arguments. */
#define LOCUS_E_ARGUMENT 10    /* an argument is NULL, out of its range or contradicts another one */
#define LOCUS_E_RANGE 11       /* a value cannot be represented in the words the object was created with */
#define LOCUS_E_CAPACITY 12    /* the caller's memory is too small; the count that is needed was stored */
#define LOCUS_E_STATE 13       /* the object is not in a state that allows the call */
#define LOCUS_E_UNSUPPORTED 14 /* not available in this build or on this machine */
/* The course of the call. */
#define LOCUS_E_STOPPED 20 /* a callback asked to stop, or the work was cancelled */
#define LOCUS_E_BUSY 21    /* another thread is inside a call that excludes this one */
#define LOCUS_E_STALE 22   /* the snapshot outlived its memory budget */
/* The outside world. */
#define LOCUS_E_MEMORY 30 /* out of memory */
#define LOCUS_E_IO 31     /* the operating system refused to read or write */
#define LOCUS_E_FORMAT 32 /* bytes from outside are not what they claim to be */
#define LOCUS_E_DEVICE 33 /* the GPU or its driver reported an error */
/* The library itself. */
#define LOCUS_E_INTERNAL 90 /* a defect in Locus; please report the text of locus_last_error() */

/* The version of the library that is loaded, as LOCUS_VERSION.
 * Cannot fail. Any thread. Since 0.1. */
LOCUS_API uint32_t locus_version(void) LOCUS_NOEXCEPT;

/* The version as text, such as "0.1.0", followed by what was built in, such as "0.1.0 simd=highway cuda=no".
 * The text is static: never release it. Cannot fail. Any thread. Since 0.1. */
LOCUS_API const char *locus_version_text(void) LOCUS_NOEXCEPT;

/* The constant's name of a status, such as "LOCUS_E_RANGE"; "LOCUS_E_UNKNOWN" for a number this library does not know.
 * The text is static: never release it. Cannot fail. Any thread. Since 0.1. */
LOCUS_API const char *locus_status_name(locus_status status) LOCUS_NOEXCEPT;

/* What went wrong in the calling thread's latest failed call, naming the function, the argument and the offending
 * value. The text belongs to the thread: it stays valid until that thread's next failed call or its end, and a
 * successful call leaves it alone. "" when nothing has failed yet. Cannot fail. Any thread. Since 0.1. */
LOCUS_API const char *locus_last_error(void) LOCUS_NOEXCEPT;

/* Log levels. The library prints nothing; it tells a handle's log callback, when the options carry one. */
#define LOCUS_LOG_DEBUG 10
#define LOCUS_LOG_INFO 20
#define LOCUS_LOG_WARNING 30

/* Receives one line of text (UTF-8, no line end, valid during the call only) of the given level. Called on the thread
 * that called the library, never under a lock; must not throw, longjmp or call into the handle it reports on. */
typedef void (*locus_log_fn)(int32_t level, const char *text, void *user);

/* Told how far long work has come: `fraction` in 0..1, never decreasing. Return 0 to go on, any other value to cancel:
 * the call then returns LOCUS_E_STOPPED. Called on the thread that called the library, never under a lock, at most a
 * few hundred times a call; must not throw, longjmp or call into the handle that is at work. */
typedef int32_t (*locus_progress_fn)(double fraction, void *user);

#ifdef __cplusplus
}
#endif
#endif
