// Volumes written and read back: every type, format, way of storing and number of components.
#include "tests/unit/io/volume_files.hpp"

#include <cmath>

namespace {

using namespace volume_test;

// A grid turned about z by 30 degrees: unit vectors per axis.
void turn(locus_volume_info &info) {
    const double c = std::sqrt(0.75);
    const double turned[9] = {c, 0.5, 0, -0.5, c, 0, 0, 0, 1};
    std::ranges::copy(turned, info.direction);
}

void expect_same_place(const locus_volume_info &a, const locus_volume_info &b) {
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(a.dims[axis], b.dims[axis]);
        EXPECT_DOUBLE_EQ(a.spacing[axis], b.spacing[axis]);
        EXPECT_DOUBLE_EQ(a.origin[axis], b.origin[axis]);
    }
    for (int i = 0; i < 9; ++i)
        EXPECT_NEAR(a.direction[i], b.direction[i], 1e-15);
    EXPECT_EQ(a.components, b.components);
}

class RoundTrip : public testing::TestWithParam<std::tuple<const char *, uint32_t, uint64_t>> {};

TEST_P(RoundTrip, KeepsNumbersAndPlace) {
    const char *ending = std::get<0>(GetParam());
    const uint32_t compression = std::get<1>(GetParam());
    const uint64_t components = std::get<2>(GetParam());
    const Folder folder;
    for_every_type([&]<typename T>(uint32_t type, T) {
        locus_volume_info info = make_info(7, 5, 3, type);
        info.components = components;
        info.spacing[0] = 0.1, info.spacing[1] = 1.0 / 3, info.spacing[2] = 2e5;
        info.origin[0] = -5, info.origin[1] = 0.7, info.origin[2] = 1e-9;
        turn(info);
        const std::vector<T> numbers = sample<T>(count_of(info));
        locus_volume_write_options options;
        ASSERT_EQ(locus_volume_write_options_init(&options, sizeof options), LOCUS_OK);
        options.compression = compression;
        const std::string path = folder / (std::to_string(type) + ending);
        ASSERT_EQ(locus_volume_write(path.c_str(), &info, numbers.data(), &options), LOCUS_OK) << locus_io_last_error();

        locus_volume_read_options keep = read_options();
        keep.numbers = LOCUS_READ_KEEP;
        const Volume kept = read(path, &keep);
        ASSERT_TRUE(kept);
        EXPECT_EQ(bytes_of(numbers_of<T>(kept)), bytes_of(numbers)) << path;
        expect_same_place(info_of(kept), info);
        EXPECT_EQ(info_of(kept).type, type);
        const Volume floats = read(path);
        EXPECT_EQ(numbers_of<float>(floats), as_float(numbers)) << path;
        EXPECT_EQ(info_of(floats).type, uint32_t{LOCUS_VOXEL_FLOAT32});
        EXPECT_EQ(info_of(floats).file_type, type);

        locus_volume_info told{};
        told.struct_size = sizeof told;
        ASSERT_EQ(locus_volume_read_info(path.c_str(), &keep, &told), LOCUS_OK);
        expect_same_place(told, info);
    });
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         testing::Combine(testing::Values(".mha", ".mhd", ".nrrd", ".nhdr"),
                                          testing::Values(0u, 1u, 9u), testing::Values(1u, 4u)));

TEST(Written, AnMhdNamesItsDataBesideIt) {
    const Folder folder;
    const locus_volume_info info = make_info(2, 1, 1, LOCUS_VOXEL_UINT8);
    const uint8_t numbers[2] = {1, 2};
    ASSERT_EQ(locus_volume_write((folder / "a.mhd").c_str(), &info, numbers, nullptr), LOCUS_OK);
    ASSERT_EQ(locus_volume_write((folder / "b.nhdr").c_str(), &info, numbers, nullptr), LOCUS_OK);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.mhd", "a.raw", "b.nhdr", "b.raw"}));
    EXPECT_EQ(content(folder / "a.raw"), "\x01\x02");
    EXPECT_NE(content(folder / "a.mhd").find("ElementDataFile = a.raw\n"), std::string::npos);
    EXPECT_NE(content(folder / "b.nhdr").find("data file: b.raw\n"), std::string::npos);
}

TEST(Written, ComponentsLieSideBySideInTheFile) {
    const Folder folder;
    locus_volume_info info = make_info(2, 1, 1, LOCUS_VOXEL_UINT8);
    info.components = 2;
    const uint8_t numbers[4] = {1, 2, 11, 12}; // component 0 of both voxels, then component 1
    const std::string path = folder / "list.nrrd";
    ASSERT_EQ(locus_volume_write(path.c_str(), &info, numbers, nullptr), LOCUS_OK);
    const std::string file = content(path);
    EXPECT_TRUE(file.ends_with("\n\n\x01\x0b\x02\x0c"));
    EXPECT_NE(file.find("sizes: 2 2 1 1\nspace: "), std::string::npos); // in this order, for VTK's sake
    EXPECT_NE(file.find("kinds: list domain domain domain\n"), std::string::npos);
    EXPECT_NE(file.find("space directions: none (1,0,0) (0,1,0) (0,0,1)\n"), std::string::npos);
}

TEST(Written, LargerThanThePiecesThatAreRead) {
    const Folder folder;
    locus_volume_info info = make_info(300, 200, 20, LOCUS_VOXEL_UINT16);
    info.components = 3;
    const auto numbers = sample<uint16_t>(count_of(info));
    locus_volume_write_options options;
    ASSERT_EQ(locus_volume_write_options_init(&options, sizeof options), LOCUS_OK);
    for (options.compression = 0; options.compression < 2; ++options.compression) {
        const std::string path = folder / "large.nrrd";
        ASSERT_EQ(locus_volume_write(path.c_str(), &info, numbers.data(), &options), LOCUS_OK);
        EXPECT_TRUE(numbers_of<float>(read(path)) == as_float(numbers));
    }
}

} // namespace
