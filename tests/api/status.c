/* locus/status.h: version, names of the statuses. */
#include "check.h"

#include <locus/locus.h>

static const struct {
    locus_status number;
    const char *name;
} statuses[] = {
    /* The numbers are part of the ABI: they are written out here. */
    {0, "LOCUS_OK"},
    {10, "LOCUS_E_ARGUMENT"},
    {11, "LOCUS_E_RANGE"},
    {12, "LOCUS_E_CAPACITY"},
    {13, "LOCUS_E_STATE"},
    {14, "LOCUS_E_UNSUPPORTED"},
    {20, "LOCUS_E_STOPPED"},
    {21, "LOCUS_E_BUSY"},
    {22, "LOCUS_E_STALE"},
    {30, "LOCUS_E_MEMORY"},
    {31, "LOCUS_E_IO"},
    {32, "LOCUS_E_FORMAT"},
    {33, "LOCUS_E_DEVICE"},
    {90, "LOCUS_E_INTERNAL"},
    {1, "LOCUS_E_UNKNOWN"},
    {-1, "LOCUS_E_UNKNOWN"},
    {91, "LOCUS_E_UNKNOWN"},
    {INT32_MAX, "LOCUS_E_UNKNOWN"},
    {INT32_MIN, "LOCUS_E_UNKNOWN"},
};

int main(void) {
    char version[64];
    size_t i;
    snprintf(version, sizeof version, "%d.%d.%d", LOCUS_VERSION_MAJOR, LOCUS_VERSION_MINOR, LOCUS_VERSION_PATCH);
    CHECK(locus_version() == LOCUS_VERSION);
    CHECK(strncmp(locus_version_text(), version, strlen(version)) == 0);
    CHECK(strstr(locus_version_text(), "simd=") != NULL);
    CHECK(strstr(locus_version_text(), " cuda=yes") != NULL || strstr(locus_version_text(), " cuda=no") != NULL);
    for (i = 0; i < sizeof statuses / sizeof statuses[0]; i++)
        CHECK(strcmp(locus_status_name(statuses[i].number), statuses[i].name) == 0);
    CHECK(strcmp(locus_last_error(), "") == 0); /* nothing has failed yet */
    return check_result();
}
