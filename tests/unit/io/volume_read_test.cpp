// Reading text-headed and raw volumes that others wrote: byte orders, ways of storing, axes and spaces.
#include "tests/unit/io/volume_files.hpp"

namespace {

using namespace volume_test;

// The names of the types in the two text formats, in the order of LOCUS_VOXEL_.
constexpr const char *meta_names[] = {"",          "MET_UCHAR", "MET_CHAR",       "MET_USHORT",    "MET_SHORT",
                                      "MET_UINT",  "MET_INT",   "MET_ULONG_LONG", "MET_LONG_LONG", "MET_FLOAT",
                                      "MET_DOUBLE"};
constexpr const char *nrrd_names[] = {"",    "unsigned char", "signed char", "ushort", "short", "unsigned int",
                                      "int", "uint64_t",      "long long",   "float",  "double"};

locus_volume_read_options keep() {
    locus_volume_read_options options = read_options();
    options.numbers = LOCUS_READ_KEEP;
    return options;
}

TEST(VolumeRead, EveryTypeInEitherByteOrder) {
    const Folder folder;
    const auto options = keep();
    for (const bool big : {false, true})
        for_every_type([&]<typename T>(uint32_t type, T) {
            const std::vector<T> numbers = sample<T>(24);
            const std::string bytes = bytes_of(numbers, big);
            const std::string meta = "ObjectType = Image\r\nNDims = 3\r\nDimSize = 4 3 2\r\nElementByteOrderMSB = " +
                                     std::string(big ? "True" : "False") + "\r\nElementType = " + meta_names[type] +
                                     "\r\nElementDataFile = LOCAL\r\n";
            const std::string nrrd =
                std::string("NRRD0001\ntype: ") + nrrd_names[type] +
                "\ndimension: 3\nsizes: 4 3 2\nencoding: raw\nendian: " + (big ? "big" : "little") + "\n\n";
            locus_volume_read_options raw = options;
            raw.format = LOCUS_VOLUME_RAW;
            raw.raw_dims[0] = 4, raw.raw_dims[1] = 3, raw.raw_dims[2] = 2;
            raw.raw_type = type;
            raw.raw_big_endian = big ? 1 : 0;
            raw.raw_offset = 5;
            const Volume volumes[] = {read(folder.write("v.mha", meta + bytes), &options),
                                      read(folder.write("v.nrrd", nrrd + bytes), &options),
                                      read(folder.write("v.dat", "12345" + bytes), &raw)};
            for (const Volume &volume : volumes) {
                ASSERT_TRUE(volume);
                EXPECT_EQ(info_of(volume).type, type);
                EXPECT_TRUE(sizeof(T) == 1 || info_of(volume).big_endian == (big ? 1u : 0u));
                EXPECT_EQ(bytes_of(numbers_of<T>(volume)), bytes_of(numbers));
            }
        });
}

TEST(VolumeRead, MetaImageFieldsAndPlaces) {
    const Folder folder;
    folder.write("d.raw", "headABCDEF");
    const std::string fields = "NDims = 2\nDimSize = 3 2\nElementSize = 0.5 0.25\nPosition = 7 -8\n"
                               "Rotation = 0 1 -1 0\nElementType = MET_UCHAR\nComment = any\n"
                               "ElementToIntensityFunctionSlope = 2\nElementToIntensityFunctionOffset = -1\n";
    for (const char *skip : {"HeaderSize = 4\n", "HeaderSize = -1\n"}) {
        const Volume volume = read(folder.write("v.mhd", fields + skip + "ElementDataFile = d.raw"));
        ASSERT_TRUE(volume);
        const locus_volume_info info = info_of(volume);
        EXPECT_EQ(info.dims[0], 3u);
        EXPECT_EQ(info.dims[2], 1u);
        EXPECT_EQ(info.spacing[1], 0.25);
        EXPECT_EQ(info.spacing[2], 1.0);
        EXPECT_EQ(info.origin[1], -8.0);
        EXPECT_EQ(info.direction[1], 1.0);
        EXPECT_EQ(info.direction[3], -1.0);
        EXPECT_EQ(info.direction[8], 1.0);
        EXPECT_EQ(numbers_of<float>(volume), (std::vector<float>{129, 131, 133, 135, 137, 139}));
        const auto options = keep();
        const Volume kept = read(folder / "v.mhd", &options);
        EXPECT_EQ(info_of(kept).slope, 2.0);
        EXPECT_EQ(info_of(kept).intercept, -1.0);
        EXPECT_EQ(numbers_of<uint8_t>(kept), (std::vector<uint8_t>{'A', 'B', 'C', 'D', 'E', 'F'}));
    }
}

TEST(VolumeRead, MetaImageFourthAxisAndChannels) {
    const Folder folder;
    const std::string rest = "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
    const Volume planar = read(folder.write("p.mha", "NDims = 4\nDimSize = 2 1 1 2\n" + rest + "abcd"));
    EXPECT_EQ(info_of(planar).components, 2u);
    EXPECT_EQ(numbers_of<float>(planar), (std::vector<float>{'a', 'b', 'c', 'd'}));
    const Volume channels =
        read(folder.write("c.mha", "NDims = 3\nDimSize = 2 1 1\nElementNumberOfChannels = 2\n" + rest + "abcd"));
    EXPECT_EQ(info_of(channels).components, 2u);
    EXPECT_EQ(numbers_of<float>(channels), (std::vector<float>{'a', 'c', 'b', 'd'}));
}

TEST(VolumeRead, MetaImageCompressed) {
    const Folder folder;
    const auto numbers = sample<int16_t>(60);
    const std::string fields = "NDims = 3\nDimSize = 5 4 3\nElementType = MET_SHORT\nCompressedData = True\n";
    const std::string packed = compressed(bytes_of(numbers), false);
    folder.write("v.zraw", packed);
    const std::string size = "CompressedDataSize = " + std::to_string(packed.size()) + "\n";
    for (const std::string &more : {std::string(), size}) {
        EXPECT_EQ(numbers_of<float>(read(folder.write("v.mhd", fields + more + "ElementDataFile = v.zraw\n"))),
                  as_float(numbers));
        EXPECT_EQ(numbers_of<float>(read(folder.write("v.mha", fields + more + "ElementDataFile = LOCAL\n" + packed))),
                  as_float(numbers));
    }
}

TEST(VolumeRead, NrrdSpacesBecomeLeftPosteriorSuperior) {
    const Folder folder;
    const auto with_space = [&](const char *space) {
        return info_of(
            read(folder.write("v.nrrd", std::string("NRRD0005\n# comment\ntype: uint8\ndimension: 3\nspace: ") + space +
                                            "\nsizes: 1 1 2\nspace directions: (2, 0, 0)  (0,0,3) (0,-4,0)\n"
                                            "space origin: (1,2,3)\nkey:=value: odd\nencoding: raw\n\nxy")));
    };
    const locus_volume_info lps = with_space("left-posterior-superior");
    const double spacing[3] = {2, 3, 4};
    const double direction[9] = {1, 0, 0, 0, 0, 1, 0, -1, 0};
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(lps.spacing[i], spacing[i]);
    for (int i = 0; i < 9; ++i)
        EXPECT_EQ(lps.direction[i], direction[i]);
    const locus_volume_info ras = with_space("RAS");
    EXPECT_EQ(ras.direction[0], -1.0);
    EXPECT_EQ(ras.direction[5], 1.0);
    EXPECT_EQ(ras.direction[7], 1.0);
    EXPECT_EQ(ras.origin[0], -1.0);
    EXPECT_EQ(ras.origin[1], -2.0);
    EXPECT_EQ(ras.origin[2], 3.0);
    EXPECT_EQ(with_space("left-anterior-superior").origin[0], 1.0);
    EXPECT_EQ(with_space("left-anterior-superior").origin[1], -2.0);
}

TEST(VolumeRead, NrrdComponentsFirstOrLast) {
    const Folder folder;
    const auto numbers = [&](const std::string &fields) {
        const Volume volume =
            read(folder.write("v.nrrd", "NRRD0004\ntype: uint8\ndimension: 4\nencoding: raw\n" + fields + "\nabcdef"));
        EXPECT_EQ(info_of(volume).dims[0], 3u);
        EXPECT_EQ(info_of(volume).components, 2u);
        return numbers_of<float>(volume);
    };
    const std::vector<float> planar{'a', 'b', 'c', 'd', 'e', 'f'};
    const std::vector<float> side_by_side{'a', 'c', 'e', 'b', 'd', 'f'};
    EXPECT_EQ(numbers("sizes: 2 3 1 1\nkinds: vector domain domain domain\n"), side_by_side);
    EXPECT_EQ(numbers("sizes: 2 3 1 1\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n"), side_by_side);
    EXPECT_EQ(numbers("sizes: 3 1 1 2\nkinds: domain domain domain list\nspacings: 1 2 3 nan\n"), planar);
    EXPECT_EQ(numbers("sizes: 3 1 1 2\n"), planar);
}

TEST(VolumeRead, NrrdEncodingsAndSkips) {
    const Folder folder;
    const auto numbers = sample<uint16_t>(12);
    const std::string bytes = bytes_of(numbers);
    const std::string fields = "NRRD0004\ntype: uint16\nendian: little\ndimension: 2\nsizes: 4 3\n";
    const auto check = [&](const std::string &more, const std::string &data) {
        folder.write("v.data", data);
        EXPECT_EQ(numbers_of<float>(read(folder.write("v.nhdr", fields + more + "data file: v.data\n"))),
                  as_float(numbers))
            << more;
        EXPECT_EQ(numbers_of<float>(read(folder.write("v.nrrd", fields + more + "\n" + data))), as_float(numbers))
            << more;
    };
    check("encoding: raw\n", bytes);
    check("encoding: gzip\n", compressed(bytes, true));
    check("encoding: gz\n", compressed(bytes.substr(0, 7), true) + compressed(bytes.substr(7), true));
    check("encoding: raw\nline skip: 2\n", "one\ntwo\n" + bytes);
    check("encoding: raw\nbyte skip: 3\n", "abc" + bytes);
    check("encoding: raw\nbyteskip: -1\n", "anything" + bytes);
    check("encoding: raw\nline skip: 1\nbyte skip: 1\n", "one\nx" + bytes);
    check("encoding: gzip\nbyte skip: 3\n", compressed("abc" + bytes, true));
    check("encoding: gzip\nline skip: 1\n", "one\n" + compressed(bytes, true));
}

TEST(VolumeRead, RawWithComponents) {
    const Folder folder;
    const std::string path = folder.write("v.raw", "abcdefgh");
    locus_volume_read_options options = read_options();
    options.format = LOCUS_VOLUME_RAW;
    options.raw_type = LOCUS_VOXEL_INT8;
    options.raw_dims[0] = 3, options.raw_dims[1] = options.raw_dims[2] = 1;
    options.raw_components = 2;
    options.raw_offset = 1;
    options.raw_spacing[2] = 1.5;
    EXPECT_EQ(locus_volume_read_info(path.c_str(), &options, nullptr), LOCUS_E_ARGUMENT);
    locus_volume *volume = nullptr;
    EXPECT_EQ(locus_volume_read(path.c_str(), &options, &volume), LOCUS_E_FORMAT); // a byte too many
    options.allow_trailing = 1;
    EXPECT_EQ(numbers_of<float>(read(path, &options)), (std::vector<float>{'b', 'c', 'd', 'e', 'f', 'g'}));
    options.raw_interleaved = 1;
    EXPECT_EQ(numbers_of<float>(read(path, &options)), (std::vector<float>{'b', 'd', 'f', 'c', 'e', 'g'}));
    EXPECT_EQ(info_of(read(path, &options)).spacing[2], 1.5);
}

TEST(VolumeRead, TheMemoryLimitIsKept) {
    const Folder folder;
    const std::string path = folder.write(
        "v.mha", "NDims = 3\nDimSize = 5 2 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n0123456789");
    locus_volume_read_options options = read_options();
    options.memory_limit = 39;
    locus_volume *volume = reinterpret_cast<locus_volume *>(&options);
    EXPECT_EQ(locus_volume_read(path.c_str(), &options, &volume), LOCUS_E_MEMORY);
    EXPECT_EQ(volume, nullptr);
    EXPECT_NE(std::string(locus_io_last_error()).find("40 bytes in memory, more than memory_limit, 39"),
              std::string::npos);
    options.memory_limit = 40;
    EXPECT_TRUE(read(path, &options));
    options.memory_limit = 10, options.numbers = LOCUS_READ_KEEP;
    EXPECT_TRUE(read(path, &options));
}

TEST(VolumeRead, NullIsRefusedOrFine) {
    locus_volume *volume = nullptr;
    EXPECT_EQ(locus_volume_read(nullptr, nullptr, &volume), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_volume_read("x", nullptr, nullptr), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_volume_get_info(nullptr, nullptr), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_volume_data(nullptr), nullptr);
    locus_volume_destroy(nullptr);
}

} // namespace
