/* Out of memory: each allocation of each call fails in turn. The call then returns LOCUS_E_MEMORY, the object is as it
 * was, nothing leaks, and the same call works afterwards. */
#include "check.h"

#include <errno.h>
#include <locus/locus.h>
#include <stdlib.h>

/* glibc's own names of what is replaced here. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *memory);

static long live;               /* blocks allocated and not freed */
static long until_failure = -1; /* allocations that still succeed; negative: all */

static int may_allocate(void) {
    if (until_failure < 0)
        return 1;
    if (until_failure == 0) {
        errno = ENOMEM;
        return 0;
    }
    until_failure--;
    return 1;
}

static void *counted(void *memory) {
    if (memory != NULL)
        live++;
    return memory;
}

void *malloc(size_t size) { return may_allocate() ? counted(__libc_malloc(size)) : NULL; }
void *calloc(size_t count, size_t size) { return may_allocate() ? counted(__libc_calloc(count, size)) : NULL; }
void *aligned_alloc(size_t alignment, size_t size) {
    return may_allocate() ? counted(__libc_memalign(alignment, size)) : NULL;
}
int posix_memalign(void **memory, size_t alignment, size_t size) {
    *memory = aligned_alloc(alignment, size);
    return *memory == NULL ? ENOMEM : 0;
}
void *realloc(void *memory, size_t size) {
    if (memory == NULL)
        return malloc(size);
    return may_allocate() ? __libc_realloc(memory, size) : NULL;
}
void free(void *memory) {
    if (memory == NULL)
        return;
    live--;
    __libc_free(memory);
}

/* Run `call` with its 1st, 2nd, ... allocation failing until one run succeeds; `unchanged` is looked at after each
 * failure. `limit` ends a call that would never succeed. */
#define EACH_ALLOCATION_FAILS(call, unchanged, limit)                                                                  \
    do {                                                                                                               \
        locus_status status = LOCUS_E_MEMORY;                                                                          \
        long failing;                                                                                                  \
        for (failing = 0; status == LOCUS_E_MEMORY && failing < (limit); failing++) {                                  \
            until_failure = failing;                                                                                   \
            status = (call);                                                                                           \
            until_failure = -1;                                                                                        \
            if (status == LOCUS_OK)                                                                                    \
                break;                                                                                                 \
            check_status(status, LOCUS_E_MEMORY, #call, __FILE__, __LINE__);                                           \
            CHECK(strstr(locus_last_error(), "memory") != NULL);                                                       \
            CHECK(unchanged);                                                                                          \
            if (check_failures > 0)                                                                                    \
                break;                                                                                                 \
        }                                                                                                              \
        check_status(status, LOCUS_OK, #call, __FILE__, __LINE__);                                                     \
    } while (0)

enum { RECORDS = 300 };

static int same_records(const locus_pmq *pmq, uint64_t wanted) {
    uint64_t count = 0;
    return locus_pmq_check(pmq) == LOCUS_OK && locus_pmq_count(pmq, NULL, &count) == LOCUS_OK && count == wanted;
}

static int32_t sink(const void *record, void *user) {
    (void)record;
    ++*(int *)user;
    return 0;
}

static void records(uint32_t index) {
    locus_point32 batch[RECORDS];
    locus_pmq_options options;
    locus_pmq_query west;
    locus_pmq *pmq = NULL;
    uint64_t number = 0;
    int gone = 0, i;
    memset(batch, 0, sizeof batch);
    for (i = 0; i < RECORDS; i++) {
        batch[i].latitude = i % 7 * 10 - 30;
        batch[i].longitude = i % 36 * 10 - 175;
        batch[i].time = i;
    }
    WORKS(locus_pmq_options_init(&options, sizeof options));
    options.index = index;
    options.horizon = 1000;
    options.sink = sink;
    options.sink_user = &gone;
    WORKS(locus_pmq_query_init(&west, sizeof west));
    west.region = LOCUS_REGION_BOX;
    west.box.south = -90;
    west.box.north = 90;
    west.box.west = -180;
    west.box.east = 0;
    EACH_ALLOCATION_FAILS(locus_pmq_create(&options, &pmq), pmq == NULL, 1000);
    EACH_ALLOCATION_FAILS(locus_pmq_insert(pmq, batch, 100, 100), same_records(pmq, 0) && gone == 0, 10000);
    EACH_ALLOCATION_FAILS(locus_pmq_insert(pmq, batch + 100, RECORDS - 100, RECORDS),
                          same_records(pmq, 100) && gone == 0, 10000);
    EACH_ALLOCATION_FAILS(locus_pmq_erase(pmq, &west, &number), same_records(pmq, RECORDS) && gone == 0, 10000);
    CHECK(same_records(pmq, RECORDS - number) && (uint64_t)gone == number);
    /* The clock has run on when the sweep fails: what is older than the horizon is not counted any more, and not lost.
     */
    EACH_ALLOCATION_FAILS(locus_pmq_sweep(pmq, 2000, NULL), locus_pmq_check(pmq) == LOCUS_OK, 10000);
    CHECK(same_records(pmq, 0) && gone == RECORDS);
    locus_pmq_destroy(pmq);
}

int main(void) {
    long before;
    printf("out of memory\n"); /* the stream's buffer is not a leak */
    before = live;
    records(LOCUS_INDEX_IMPLICIT);
    records(LOCUS_INDEX_EXPLICIT);
    CHECK(live == before);
    return check_result();
}
