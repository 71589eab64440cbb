/* Load and unload the library over and over: it goes away each time, and nothing of it stays in memory.
 * This program is not linked with the library. */
#define _POSIX_C_SOURCE 200809L

#include <dlfcn.h>
#include <locus/locus.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define TEXT_OF(number) #number
#define TEXT(number) TEXT_OF(number)
#define LIBRARY "liblocus.so." TEXT(LOCUS_VERSION_MAJOR)

/* A data pointer as the function it stands for (POSIX lets them be converted, C does not). */
#define FUNCTION(library, pointer, name)                                                                               \
    do {                                                                                                               \
        void *const address = dlsym(library, name);                                                                    \
        memcpy(&(pointer), &address, sizeof address);                                                                  \
    } while (0)

static long resident_pages(void) {
    long total = 0, resident = 0;
    FILE *const file = fopen("/proc/self/statm", "r");
    if (file == NULL)
        return 0;
    if (fscanf(file, "%ld %ld", &total, &resident) != 2)
        resident = 0;
    fclose(file);
    return resident;
}

/* One life of the library, with some use of it. Returns what went wrong, NULL if nothing did. */
static const char *one_life(void) {
    uint32_t (*version)(void) = NULL;
    locus_status (*create)(const locus_pmq_options *, locus_pmq **) = NULL;
    locus_status (*insert)(locus_pmq *, const void *, size_t, int64_t) = NULL;
    void (*destroy)(locus_pmq *) = NULL;
    locus_point32 record;
    locus_pmq *pmq = NULL;
    void *const library = dlopen(LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL)
        return dlerror();
    FUNCTION(library, version, "locus_version");
    if (version == NULL)
        return "locus_version is missing";
    if (version() != LOCUS_VERSION)
        return "locus_version is another version";
    FUNCTION(library, create, "locus_pmq_create");
    FUNCTION(library, insert, "locus_pmq_insert");
    FUNCTION(library, destroy, "locus_pmq_destroy");
    memset(&record, 0, sizeof record);
    if (create(NULL, &pmq) != LOCUS_OK || insert(pmq, &record, 1, 0) != LOCUS_OK)
        return "the store does not work";
    record.latitude = 91; /* an error text, which belongs to the thread */
    if (insert(pmq, &record, 1, 0) != LOCUS_E_ARGUMENT)
        return "the store takes any record";
    destroy(pmq);
    if (dlclose(library) != 0)
        return dlerror();
    if (dlopen(LIBRARY, RTLD_NOW | RTLD_NOLOAD) != NULL)
        return "dlclose left the library in memory";
    return NULL;
}

static const char *lives(int count) {
    const char *wrong = NULL;
    int i;
    for (i = 0; i < count && wrong == NULL; i++)
        wrong = one_life();
    return wrong;
}

/* With a number of loads on the command line the memory is not looked at: for Valgrind, which looks itself and needs
 * some. */
int main(int arguments, char **argument) {
    const int loads = arguments > 1 ? atoi(argument[1]) : 200;
    const char *wrong = lives(loads / 10);
    const long before = resident_pages();
    if (wrong == NULL)
        wrong = lives(loads);
    if (wrong != NULL) {
        printf("%s\n", wrong);
        return 1;
    }
    if (arguments == 1 && resident_pages() > before + 64) {
        printf("%d loads grew the process from %ld to %ld pages\n", loads, before, resident_pages());
        return 1;
    }
    return 0;
}
