/* A program outside the project, in C or C++: it sees what is installed and nothing else. */
#include <locus/locus.h>

#include <stdio.h>
#include <string.h>

int main(void) {
    printf("%s\n", locus_version_text());
    return locus_version() == LOCUS_VERSION && strcmp(locus_status_name(LOCUS_OK), "LOCUS_OK") == 0 ? 0 : 1;
}
