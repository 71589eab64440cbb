/* A record of 32 bytes. */
#ifndef POINT_H
#define POINT_H

#include <locus/pmq.h>

#include <string.h>

static inline locus_point32 point(double latitude, double longitude, int64_t time, uint16_t device) {
    locus_point32 result;
    memset(&result, 0, sizeof result);
    result.latitude = latitude;
    result.longitude = longitude;
    result.time = time;
    result.device = device;
    return result;
}

#endif
