/* Checks for the API tests: they print what failed and count it; end main with `return check_result();`. */
#ifndef CHECK_H
#define CHECK_H

#include <locus/status.h>

#include <stdio.h>
#include <string.h>

/* Tests of liblocus_io define it as locus_io_last_error before they include this. */
#ifndef LAST_ERROR
#define LAST_ERROR locus_last_error
#endif

static int check_failures = 0;

static inline void check_true(int good, const char *text, const char *file, int line) {
    if (good)
        return;
    check_failures++;
    printf("%s:%d: not so: %s\n", file, line, text);
}

static inline void check_status(locus_status found, locus_status wanted, const char *call, const char *file, int line) {
    if (found == wanted)
        return;
    check_failures++;
    printf("%s:%d: %s returned %s instead of %s; last error: %s\n", file, line, call, locus_status_name(found),
           locus_status_name(wanted), LAST_ERROR());
}

/* The call failed with `wanted`, and the error text begins with the function's name and holds `words`. */
static inline void check_refusal(locus_status found, locus_status wanted, const char *words, const char *call,
                                 const char *file, int line) {
    const char *text = LAST_ERROR();
    const size_t name = strcspn(call, "(");
    check_status(found, wanted, call, file, line);
    if (found != wanted || wanted == LOCUS_OK)
        return;
    if (strncmp(text, call, name) == 0 && text[name] == ':' && strstr(text + name, words) != NULL)
        return;
    check_failures++;
    printf("%s:%d: %s: the error text does not begin with the function's name and hold \"%s\": %s\n", file, line, call,
           words, text);
}

static inline int check_result(void) {
    if (check_failures > 0)
        printf("%d checks failed\n", check_failures);
    return check_failures > 0;
}

#define CHECK(condition) check_true((condition) != 0, #condition, __FILE__, __LINE__)
#define WORKS(call) check_status((call), LOCUS_OK, #call, __FILE__, __LINE__)
#define RETURNS(call, status) check_status((call), (status), #call, __FILE__, __LINE__)
/* tests/api/coverage.sh wants one of these for every exported function that can fail. */
#define REFUSES(call, status, words) check_refusal((call), (status), (words), #call, __FILE__, __LINE__)

#endif
