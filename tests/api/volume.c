/* locus/volume.h: a walk through the calls, and every bad argument. */
#define _XOPEN_SOURCE 700

#include <locus/volume.h>

#define LAST_ERROR locus_io_last_error
#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

enum { NX = 3, NY = 2, NZ = 2, VOXELS = NX * NY * NZ };

static char folder[64], file[128], raw[128], absent[128];
static int16_t numbers[VOXELS];

static locus_volume_info good_info(void) {
    locus_volume_info info;
    WORKS(locus_volume_info_init(&info, sizeof info));
    info.dims[0] = NX;
    info.dims[1] = NY;
    info.dims[2] = NZ;
    info.type = LOCUS_VOXEL_INT16;
    return info;
}

static void defaults(void) {
    locus_volume_info info;
    locus_volume_read_options reading;
    locus_volume_write_options writing;
    memset(&info, 0xA5, sizeof info);
    WORKS(locus_volume_info_init(&info, sizeof info));
    CHECK(info.struct_size == sizeof info && info.dims[0] == 0 && info.components == 1 && info.spacing[2] == 1);
    CHECK(info.origin[1] == 0 && info.direction[0] == 1 && info.direction[1] == 0 && info.direction[8] == 1);
    CHECK(info.slope == 1 && info.intercept == 0 && info.type == LOCUS_VOXEL_FLOAT32);
    WORKS(locus_volume_read_options_init(&reading, sizeof reading));
    CHECK(reading.memory_limit == (uint64_t)8 << 30 && reading.numbers == LOCUS_READ_FLOAT);
    CHECK(reading.format == LOCUS_VOLUME_AUTO && reading.allow_trailing == 0 && reading.raw_components == 1);
    WORKS(locus_volume_write_options_init(&writing, sizeof writing));
    CHECK(writing.format == LOCUS_VOLUME_AUTO && writing.compression == 0);
    REFUSES(locus_volume_info_init(NULL, sizeof info), LOCUS_E_ARGUMENT, "info");
    REFUSES(locus_volume_info_init(&info, 8), LOCUS_E_ARGUMENT, "size is 8");
    REFUSES(locus_volume_read_options_init(NULL, sizeof reading), LOCUS_E_ARGUMENT, "options");
    REFUSES(locus_volume_read_options_init(&reading, 8), LOCUS_E_ARGUMENT, "size is 8");
    REFUSES(locus_volume_write_options_init(NULL, sizeof writing), LOCUS_E_ARGUMENT, "options");
    REFUSES(locus_volume_write_options_init(&writing, 8), LOCUS_E_ARGUMENT, "size is 8");
}

static void bad_writes(void) {
    const locus_volume_info good = good_info();
    locus_volume_write_options options;
    union {
        locus_volume_write_options options;
        unsigned char bytes[sizeof(locus_volume_write_options) + 8];
    } newer;
    REFUSES(locus_volume_write(NULL, &good, numbers, NULL), LOCUS_E_ARGUMENT, "path is NULL");
    REFUSES(locus_volume_write(file, NULL, numbers, NULL), LOCUS_E_ARGUMENT, "info is NULL");
    REFUSES(locus_volume_write(file, &good, NULL, NULL), LOCUS_E_ARGUMENT, "data is NULL");
    REFUSES(locus_volume_write("volume.txt", &good, numbers, NULL), LOCUS_E_ARGUMENT, "volume.txt");
    REFUSES(locus_volume_write("/nowhere/at/all.nrrd", &good, numbers, NULL), LOCUS_E_IO, "/nowhere/at/all.nrrd");
#define BAD_INFO(change, words)                                                                                        \
    do {                                                                                                               \
        locus_volume_info info = good;                                                                                 \
        info.change;                                                                                                   \
        REFUSES(locus_volume_write(file, &info, numbers, NULL), LOCUS_E_ARGUMENT, words);                              \
    } while (0)
    BAD_INFO(struct_size = 0, "struct_size is 0");
    BAD_INFO(dims[1] = 0, "dims[1] is 0");
    BAD_INFO(dims[0] = UINT64_MAX, "dims");
    BAD_INFO(components = 0, "components is 0");
    BAD_INFO(spacing[0] = 0, "spacing[0] is 0");
    BAD_INFO(spacing[1] = NAN, "spacing[1]");
    BAD_INFO(origin[2] = INFINITY, "origin[2]");
    BAD_INFO(direction[4] = 7, "direction");
    BAD_INFO(slope = 2, "slope");
    BAD_INFO(intercept = 2, "intercept");
    BAD_INFO(type = 0, "type");
    BAD_INFO(type = 11, "type");
#define BAD_WRITING(change, words)                                                                                     \
    WORKS(locus_volume_write_options_init(&options, sizeof options));                                                  \
    options.change;                                                                                                    \
    REFUSES(locus_volume_write(file, &good, numbers, &options), LOCUS_E_ARGUMENT, words)
    BAD_WRITING(struct_size = 0, "struct_size is 0");
    BAD_WRITING(format = LOCUS_VOLUME_NIFTI, "format is 3");
    BAD_WRITING(compression = 10, "compression is 10");
    WORKS(locus_volume_write_options_init(&newer.options, sizeof newer));
    newer.bytes[sizeof newer - 1] = 1;
    REFUSES(locus_volume_write(file, &good, numbers, &newer.options), LOCUS_E_ARGUMENT, "struct_size");
    CHECK(access(file, F_OK) != 0); /* none of them has left a file */
}

static void bad_reads(void) {
    locus_volume_read_options options;
    locus_volume_info info = good_info();
    locus_volume *volume = NULL;
    union {
        locus_volume_read_options options;
        unsigned char bytes[sizeof(locus_volume_read_options) + 8];
    } newer;
    REFUSES(locus_volume_read(NULL, NULL, &volume), LOCUS_E_ARGUMENT, "path is NULL");
    REFUSES(locus_volume_read(file, NULL, NULL), LOCUS_E_ARGUMENT, "volume is NULL");
    REFUSES(locus_volume_read(absent, NULL, &volume), LOCUS_E_IO, absent);
    REFUSES(locus_volume_read(folder, NULL, &volume), LOCUS_E_IO, folder);
    REFUSES(locus_volume_read(raw, NULL, &volume), LOCUS_E_FORMAT, raw); /* never taken for a raw one */
    REFUSES(locus_volume_read_info(NULL, NULL, &info), LOCUS_E_ARGUMENT, "path is NULL");
    REFUSES(locus_volume_read_info(file, NULL, NULL), LOCUS_E_ARGUMENT, "info is NULL");
    REFUSES(locus_volume_read_info(absent, NULL, &info), LOCUS_E_IO, absent);
    info.struct_size = 8;
    REFUSES(locus_volume_read_info(file, NULL, &info), LOCUS_E_ARGUMENT, "struct_size is 8");
#define BAD_READING(change, status, words)                                                                             \
    WORKS(locus_volume_read_options_init(&options, sizeof options));                                                   \
    options.change;                                                                                                    \
    volume = (locus_volume *)&options;                                                                                 \
    REFUSES(locus_volume_read(file, &options, &volume), status, words);                                                \
    CHECK(volume == NULL)
    BAD_READING(struct_size = 0, LOCUS_E_ARGUMENT, "struct_size is 0");
    BAD_READING(memory_limit = 0, LOCUS_E_ARGUMENT, "memory_limit is 0");
    BAD_READING(memory_limit = VOXELS, LOCUS_E_MEMORY, "memory_limit");
    BAD_READING(numbers = 2, LOCUS_E_ARGUMENT, "numbers is 2");
    BAD_READING(format = 5, LOCUS_E_ARGUMENT, "format is 5");
    BAD_READING(format = LOCUS_VOLUME_RAW, LOCUS_E_ARGUMENT, "raw_type is 0");
    BAD_READING(allow_trailing = 2, LOCUS_E_ARGUMENT, "allow_trailing is 2");
    BAD_READING(raw_big_endian = 2, LOCUS_E_ARGUMENT, "raw_big_endian is 2");
    BAD_READING(raw_interleaved = 2, LOCUS_E_ARGUMENT, "raw_interleaved is 2");
    WORKS(locus_volume_read_options_init(&newer.options, sizeof newer));
    WORKS(locus_volume_read(file, &newer.options, &volume));
    locus_volume_destroy(volume);
    newer.bytes[sizeof newer - 8] = 1;
    REFUSES(locus_volume_read(file, &newer.options, &volume), LOCUS_E_ARGUMENT, "struct_size");
}

static void walk(void) {
    locus_volume_info info = good_info();
    locus_volume_read_options options;
    locus_volume *volume = NULL;
    int i;
    info.spacing[2] = 2.5;
    info.origin[0] = -10;
    WORKS(locus_volume_write(file, &info, numbers, NULL));
    WORKS(locus_volume_read(file, NULL, &volume));
    WORKS(locus_volume_get_info(volume, &info));
    CHECK(info.dims[0] == NX && info.dims[1] == NY && info.dims[2] == NZ && info.spacing[2] == 2.5);
    CHECK(info.origin[0] == -10 && info.type == LOCUS_VOXEL_FLOAT32 && info.file_type == LOCUS_VOXEL_INT16);
    CHECK(info.format == LOCUS_VOLUME_NRRD);
    for (i = 0; i < VOXELS; i++)
        CHECK(((const float *)locus_volume_data(volume))[i] == (float)numbers[i]);
    REFUSES(locus_volume_get_info(NULL, &info), LOCUS_E_ARGUMENT, "volume is NULL");
    REFUSES(locus_volume_get_info(volume, NULL), LOCUS_E_ARGUMENT, "info is NULL");
    info.struct_size = 8;
    REFUSES(locus_volume_get_info(volume, &info), LOCUS_E_ARGUMENT, "struct_size is 8");
    locus_volume_destroy(volume);
    locus_volume_destroy(NULL);
    CHECK(locus_volume_data(NULL) == NULL);

    /* The same numbers without a header. */
    WORKS(locus_volume_read_options_init(&options, sizeof options));
    options.format = LOCUS_VOLUME_RAW;
    options.numbers = LOCUS_READ_KEEP;
    options.raw_type = LOCUS_VOXEL_INT16;
    options.raw_dims[0] = VOXELS;
    options.raw_dims[1] = options.raw_dims[2] = 1;
    WORKS(locus_volume_read(raw, &options, &volume));
    CHECK(memcmp(locus_volume_data(volume), numbers, sizeof numbers) == 0);
    locus_volume_destroy(volume);
    info.struct_size = sizeof info;
    WORKS(locus_volume_read_info(raw, &options, &info));
    CHECK(info.dims[0] == VOXELS && info.type == LOCUS_VOXEL_INT16);
    options.raw_dims[0] = VOXELS + 1;
    REFUSES(locus_volume_read(raw, &options, &volume), LOCUS_E_FORMAT, raw);
}

int main(void) {
    FILE *bytes;
    int i;
    strcpy(folder, "/tmp/locus-api-XXXXXX");
    if (mkdtemp(folder) == NULL)
        return 2;
    snprintf(file, sizeof file, "%s/volume.nrrd", folder);
    snprintf(raw, sizeof raw, "%s/volume.raw", folder);
    snprintf(absent, sizeof absent, "%s/absent.nrrd", folder);
    for (i = 0; i < VOXELS; i++)
        numbers[i] = (int16_t)(100 * i - 300);
    bytes = fopen(raw, "wb");
    CHECK(bytes != NULL && fwrite(numbers, sizeof numbers, 1, bytes) == 1);
    if (bytes != NULL)
        fclose(bytes);
    defaults();
    bad_writes();
    walk();
    bad_reads();
    CHECK(remove(file) == 0 && remove(raw) == 0 && rmdir(folder) == 0); /* and nothing else was left there */
    return check_result();
}
