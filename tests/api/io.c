/* locus/io.h: the error text of liblocus_io. */
#include <locus/io.h>

#define LAST_ERROR locus_io_last_error
#include "check.h"

int main(void) {
    CHECK(strcmp(locus_io_last_error(), "") == 0); /* nothing has failed yet */
    return check_result();
}
