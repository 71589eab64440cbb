/* locus/volume.h - volume files: read MetaImage, NRRD, NIfTI and raw arrays, write MetaImage and NRRD (liblocus_io).
 *
 * A volume is a dense array of 8- to 64-bit numbers, x fastest: component c of the voxel (x, y, z) has the index
 * x + nx * (y + ny * (z + nz * c)), so every component is a plain volume that locus_graph_create takes as it is.
 * Files are read within bounds and validated first: what they claim (dims, types, sizes, places) is checked against
 * what is there before memory is taken, and an error names the file and the value that is wrong.
 *
 * Places in the world are in the file's unit of length (millimetres in medicine), along the axes left, posterior,
 * superior: those of MetaImage, of NRRD's "left-posterior-superior" and of DICOM. NIfTI and NRRD's other anatomical
 * spaces are converted. */
#ifndef LOCUS_VOLUME_H
#define LOCUS_VOLUME_H

#include <locus/io.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A volume that was read: its numbers and what is known about them. */
typedef struct locus_volume locus_volume;

/* Types of numbers, in memory in the machine's byte order. */
#define LOCUS_VOXEL_UINT8 1
#define LOCUS_VOXEL_INT8 2
#define LOCUS_VOXEL_UINT16 3
#define LOCUS_VOXEL_INT16 4
#define LOCUS_VOXEL_UINT32 5
#define LOCUS_VOXEL_INT32 6
#define LOCUS_VOXEL_UINT64 7
#define LOCUS_VOXEL_INT64 8
#define LOCUS_VOXEL_FLOAT32 9
#define LOCUS_VOXEL_FLOAT64 10

/* File formats. */
#define LOCUS_VOLUME_AUTO 0      /* reading: from the first bytes; writing: from the ending of the name */
#define LOCUS_VOLUME_METAIMAGE 1 /* .mha (one file), .mhd (header beside its data); raw or zlib */
#define LOCUS_VOLUME_NRRD 2      /* .nrrd (one file), .nhdr (header beside its data); raw or gzip */
#define LOCUS_VOLUME_NIFTI 3     /* .nii, .nii.gz, versions 1 and 2; reading only */
#define LOCUS_VOLUME_RAW 4       /* nothing but numbers, described by `raw` in the options; reading only */

/* What is known about a volume. Fill one with locus_volume_info_init before writing. */
typedef struct locus_volume_info {
    uint64_t struct_size;
    uint64_t dims[3];    /* voxels in x, y, z, each >= 1, product < 2^40; a plane has nz = 1; default 0: must be set */
    uint64_t components; /* numbers per voxel, 1..2^24; default 1 */
    double spacing[3];   /* a voxel's edge lengths, finite and > 0; default 1 */
    double origin[3];    /* where the centre of voxel (0, 0, 0) lies, finite; default 0 */
    double direction[9]; /* unit vectors along the grid's x, y and z axes, three numbers each; default the identity */
    /* value = slope * number + intercept; defaults 1 and 0. Reading to float applies both, and then they are 1 and 0
     * here; reading with LOCUS_READ_KEEP reports them. Writing takes 1 and 0 only. */
    double slope;
    double intercept;
    uint32_t type;       /* LOCUS_VOXEL_ of the numbers in memory; default LOCUS_VOXEL_FLOAT32 */
    uint32_t file_type;  /* LOCUS_VOXEL_ in the file; ignored by writing */
    uint32_t format;     /* LOCUS_VOLUME_ of the file; ignored by writing */
    uint32_t big_endian; /* 1: the file's numbers have their high byte first; ignored by writing */
} locus_volume_info;

/* What the numbers become in memory. */
#define LOCUS_READ_FLOAT 0 /* float, slope and intercept applied; a double beyond its range becomes infinite */
#define LOCUS_READ_KEEP 1  /* the file's own type, unchanged */

typedef struct locus_volume_read_options {
    uint64_t struct_size;
    uint64_t memory_limit;   /* most bytes the numbers may take in memory, > 0; default 8 GiB */
    uint32_t numbers;        /* LOCUS_READ_; default LOCUS_READ_FLOAT */
    uint32_t format;         /* LOCUS_VOLUME_; default LOCUS_VOLUME_AUTO, which never takes a file for a raw one */
    uint32_t allow_trailing; /* 1: bytes after the numbers are fine; default 0: they are an error (wrong dims?) */
    /* For LOCUS_VOLUME_RAW alone. */
    uint32_t raw_big_endian;  /* 1: high byte first; default 0 */
    uint32_t raw_type;        /* LOCUS_VOXEL_; default 0: must be set */
    uint32_t raw_interleaved; /* 1: the components of a voxel lie side by side; default 0: one volume after the other */
    uint64_t raw_dims[3];     /* default 0: must be set */
    uint64_t raw_components;  /* default 1 */
    uint64_t raw_offset;      /* bytes before the numbers; default 0 */
    double raw_spacing[3];    /* default 1 */
    double raw_origin[3];     /* default 0 */
} locus_volume_read_options;

typedef struct locus_volume_write_options {
    uint64_t struct_size;
    uint32_t format; /* LOCUS_VOLUME_METAIMAGE or LOCUS_VOLUME_NRRD; default LOCUS_VOLUME_AUTO: by the name's ending */
    uint32_t compression; /* 0: none; 1 (fast) to 9 (small): zlib (MetaImage) or gzip (NRRD); default 0 */
} locus_volume_write_options;

/* Fill the struct (of `size` bytes: pass sizeof) with the defaults stated at the fields.
 * Errors: LOCUS_E_ARGUMENT for NULL or a size smaller than the first release's. Any thread. Since 0.1. */
LOCUS_API locus_status locus_volume_info_init(locus_volume_info *info, size_t size) LOCUS_NOEXCEPT;
LOCUS_API locus_status locus_volume_read_options_init(locus_volume_read_options *options, size_t size) LOCUS_NOEXCEPT;
LOCUS_API locus_status locus_volume_write_options_init(locus_volume_write_options *options, size_t size) LOCUS_NOEXCEPT;

/* Read the volume file at `path` (NUL-ended, bytes as the system takes them). `options` may be NULL for the defaults.
 * A header beside its data may name its data only in its own folder or below, and only as a regular file.
 * `*volume` is the caller's, to be ended with locus_volume_destroy; NULL on any error.
 * Errors: LOCUS_E_ARGUMENT (an option out of its range), LOCUS_E_IO (a file cannot be opened or read), LOCUS_E_FORMAT
 * (it is damaged, too short, too long or contradicts itself), LOCUS_E_UNSUPPORTED (it is sound as far as one can see,
 * but of a kind not read here), LOCUS_E_MEMORY (memory_limit, or no memory). Any thread. Since 0.1. */
LOCUS_API locus_status locus_volume_read(const char *path, const locus_volume_read_options *options,
                                         locus_volume **volume) LOCUS_NOEXCEPT;

/* Read the header alone: `*info` (set info->struct_size first) says what locus_volume_read would give, and the sizes of
 * the files were checked, but no numbers were read; memory_limit does not matter. Errors as there. Any thread. Since
 * 0.1. */
LOCUS_API locus_status locus_volume_read_info(const char *path, const locus_volume_read_options *options,
                                              locus_volume_info *info) LOCUS_NOEXCEPT;

/* End a volume. NULL is fine. Since 0.1. */
LOCUS_API void locus_volume_destroy(locus_volume *volume) LOCUS_NOEXCEPT;

/* Store what is known about a volume in `*info`; set info->struct_size to sizeof *info before the call.
 * Errors: LOCUS_E_ARGUMENT. Beside other readers. Since 0.1. */
LOCUS_API locus_status locus_volume_get_info(const locus_volume *volume, locus_volume_info *info) LOCUS_NOEXCEPT;

/* The numbers, dims[0] * dims[1] * dims[2] * components of the info's type, aligned for any of the types (float after
 * LOCUS_READ_FLOAT). They belong to the volume: they stay until it is destroyed. NULL for NULL. Beside other
 * readers. Since 0.1. */
LOCUS_API const void *locus_volume_data(const locus_volume *volume) LOCUS_NOEXCEPT;

/* Write `data`, laid out as `info` says, to the file at `path`. `options` may be NULL for the defaults.
 * The components of a voxel lie side by side in the file: NRRD has a first axis of kind "list", MetaImage has channels.
 * Data are written under a temporary name in the same folder, flushed to the disk and renamed, so that a reader sees
 * the old file or the new one, never a part. An .mhd or .nhdr is written after its data, which go into a file of the
 * same name ending in .raw, .zraw (MetaImage, compressed) or .raw.gz (NRRD, compressed). 3-D Slicer and ParaView open
 * both formats, but ParaView (VTK 9.1) misreads an NRRD list of components that is compressed.
 * Errors: LOCUS_E_ARGUMENT (a field of the info or options out of its range, an ending that names no format),
 * LOCUS_E_IO (a full disk, a folder that is not there, ...: no file is left behind, an older one stays),
 * LOCUS_E_MEMORY. Any thread. Since 0.1. */
LOCUS_API locus_status locus_volume_write(const char *path, const locus_volume_info *info, const void *data,
                                          const locus_volume_write_options *options) LOCUS_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#endif
