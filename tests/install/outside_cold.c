/* A program outside the project that uses liblocus_cold: what it needs of liblocus comes with it. */
#include <locus/cold.h>

int main(void) { return locus_version() == LOCUS_VERSION && locus_cold_last_error()[0] == '\0' ? 0 : 1; }
