/* A program outside the project that uses liblocus_io too. */
#include <locus/io.h>
#include <locus/locus.h>

int main(void) { return locus_version() == LOCUS_VERSION && locus_io_last_error()[0] == '\0' ? 0 : 1; }
