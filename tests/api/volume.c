/* locus/volume.h from C: write a volume, read it back, be refused; and the layout of its structs. */
#define _DEFAULT_SOURCE /* mkdtemp */
#include <locus/volume.h>

#define LAST_ERROR locus_io_last_error
#include "check.h"

#include <stddef.h>
#include <stdlib.h>
#include <unistd.h>

#define SIZE(type, bytes) CHECK(sizeof(type) == (bytes))
#define FIELD(type, field, bytes) CHECK(offsetof(type, field) == (bytes))

static void check_layout(void) {
    SIZE(locus_volume_info, 192);
    FIELD(locus_volume_info, struct_size, 0);
    FIELD(locus_volume_info, dims, 8);
    FIELD(locus_volume_info, components, 32);
    FIELD(locus_volume_info, spacing, 40);
    FIELD(locus_volume_info, origin, 64);
    FIELD(locus_volume_info, direction, 88);
    FIELD(locus_volume_info, slope, 160);
    FIELD(locus_volume_info, intercept, 168);
    FIELD(locus_volume_info, type, 176);
    FIELD(locus_volume_info, file_type, 180);
    FIELD(locus_volume_info, format, 184);
    FIELD(locus_volume_info, big_endian, 188);
    SIZE(locus_volume_read_options, 128);
    FIELD(locus_volume_read_options, struct_size, 0);
    FIELD(locus_volume_read_options, memory_limit, 8);
    FIELD(locus_volume_read_options, numbers, 16);
    FIELD(locus_volume_read_options, format, 20);
    FIELD(locus_volume_read_options, allow_trailing, 24);
    FIELD(locus_volume_read_options, raw_big_endian, 28);
    FIELD(locus_volume_read_options, raw_type, 32);
    FIELD(locus_volume_read_options, raw_interleaved, 36);
    FIELD(locus_volume_read_options, raw_dims, 40);
    FIELD(locus_volume_read_options, raw_components, 64);
    FIELD(locus_volume_read_options, raw_offset, 72);
    FIELD(locus_volume_read_options, raw_spacing, 80);
    FIELD(locus_volume_read_options, raw_origin, 104);
    SIZE(locus_volume_write_options, 16);
    FIELD(locus_volume_write_options, struct_size, 0);
    FIELD(locus_volume_write_options, format, 8);
    FIELD(locus_volume_write_options, compression, 12);
}

static void check_round_trip(const char *path) {
    const uint16_t numbers[6] = {1, 2, 3, 40000, 5, 6};
    locus_volume_info info;
    locus_volume_write_options write;
    locus_volume_read_options read;
    locus_volume *volume = NULL;
    WORKS(locus_volume_info_init(&info, sizeof info));
    WORKS(locus_volume_write_options_init(&write, sizeof write));
    WORKS(locus_volume_read_options_init(&read, sizeof read));
    info.dims[0] = 3;
    info.dims[1] = 2;
    info.dims[2] = 1;
    info.type = LOCUS_VOXEL_UINT16;
    info.spacing[2] = 1.5;
    write.compression = 6;
    WORKS(locus_volume_write(path, &info, numbers, &write));
    WORKS(locus_volume_read_info(path, NULL, &info));
    CHECK(info.type == LOCUS_VOXEL_FLOAT32 && info.file_type == LOCUS_VOXEL_UINT16 && info.spacing[2] == 1.5);
    read.numbers = LOCUS_READ_KEEP;
    WORKS(locus_volume_read(path, &read, &volume));
    WORKS(locus_volume_get_info(volume, &info));
    CHECK(info.dims[0] == 3 && info.dims[1] == 2 && info.dims[2] == 1 && info.type == LOCUS_VOXEL_UINT16);
    CHECK(memcmp(locus_volume_data(volume), numbers, sizeof numbers) == 0);
    REFUSES(locus_volume_get_info(volume, NULL), LOCUS_E_ARGUMENT, "info is NULL");
    locus_volume_destroy(volume);
    WORKS(locus_volume_read(path, NULL, &volume));
    CHECK(((const float *)locus_volume_data(volume))[3] == 40000.0f);
    locus_volume_destroy(volume);
}

static void check_refusals(const char *path) {
    locus_volume_info info;
    locus_volume_read_options read;
    locus_volume_write_options write;
    locus_volume *volume = NULL;
    const float number = 1;
    REFUSES(locus_volume_info_init(NULL, sizeof info), LOCUS_E_ARGUMENT, "NULL");
    REFUSES(locus_volume_info_init(&info, 8), LOCUS_E_ARGUMENT, "size is 8");
    REFUSES(locus_volume_read_options_init(&read, 8), LOCUS_E_ARGUMENT, "size is 8");
    REFUSES(locus_volume_write_options_init(&write, 8), LOCUS_E_ARGUMENT, "size is 8");
    WORKS(locus_volume_info_init(&info, sizeof info));
    REFUSES(locus_volume_write(path, &info, &number, NULL), LOCUS_E_ARGUMENT, "dims[0] is 0");
    REFUSES(locus_volume_read(path, NULL, NULL), LOCUS_E_ARGUMENT, "volume is NULL");
    REFUSES(locus_volume_read(path, NULL, &volume), LOCUS_E_IO, path);
    CHECK(volume == NULL);
    REFUSES(locus_volume_read_info(path, NULL, &info), LOCUS_E_IO, path);
    REFUSES(locus_volume_read_info(path, NULL, NULL), LOCUS_E_ARGUMENT, "info is NULL");
    REFUSES(locus_volume_get_info(NULL, &info), LOCUS_E_ARGUMENT, "volume is NULL");
    CHECK(locus_volume_data(NULL) == NULL);
    locus_volume_destroy(NULL);
}

int main(void) {
    char folder[] = "/tmp/locus-api-volume-XXXXXX";
    char path[64];
    if (mkdtemp(folder) == NULL)
        return 1;
    snprintf(path, sizeof path, "%s/v.nrrd", folder);
    check_layout();
    check_refusals(path);
    check_round_trip(path);
    unlink(path);
    rmdir(folder);
    return check_result();
}
