// NIfTI files made by hand, field by field, from the format's definition (nifti1.h, nifti2.h).
#include "tests/unit/io/volume_files.hpp"

#include <cmath>
#include <limits>
#include <unistd.h>

namespace {

using namespace volume_test;

// A header under construction: numbers are put at byte offsets in the wanted byte order.
struct Header {
    Header(int given_version, bool given_big) : version(given_version), big(given_big) {
        bytes.resize(version == 1 ? 352 : 544); // with the four bytes that say "no extensions"
        put<int32_t>(0, version == 1 ? 348 : 540);
        const std::string magic = version == 1 ? "n+1" : "n+2";
        bytes.replace(version == 1 ? 344 : 4, 3, magic);
        if (version == 1)
            put<float>(108, 352);
        else
            put<int64_t>(168, 544);
    }
    template <typename T>
    void put(size_t offset, T value) {
        bytes.replace(offset, sizeof(T), bytes_of(std::vector<T>{value}, big));
    }
    void dims(std::vector<int64_t> sizes) {
        sizes.insert(sizes.begin(), static_cast<int64_t>(sizes.size()));
        for (size_t i = 0; i < sizes.size(); ++i)
            version == 1 ? put(40 + 2 * i, static_cast<int16_t>(sizes[i])) : put(16 + 8 * i, sizes[i]);
    }
    void type(int16_t code, int16_t bits) {
        put(version == 1 ? 70 : 12, code);
        put(version == 1 ? 72 : 14, bits);
    }
    void pixdim(size_t axis, double value) {
        version == 1 ? put(76 + 4 * axis, static_cast<float>(value)) : put(104 + 8 * axis, value);
    }
    void real(size_t offset1, size_t offset2, double value) { // of version 1 and of version 2
        version == 1 ? put(offset1, static_cast<float>(value)) : put(offset2, value);
    }
    void scaling(double slope, double intercept) { real(112, 176, slope), real(116, 184, intercept); }
    void code(size_t offset1, size_t offset2, int value) {
        version == 1 ? put(offset1, static_cast<int16_t>(value)) : put(offset2, static_cast<int32_t>(value));
    }

    int version;
    bool big;
    std::string bytes;
};

// The codes and bits of NIfTI in the order of LOCUS_VOXEL_.
constexpr int16_t codes[] = {0, 2, 256, 512, 4, 768, 8, 1280, 1024, 16, 64};

class Nifti : public testing::TestWithParam<std::tuple<int, bool>> {
protected:
    Header header() const { return {std::get<0>(GetParam()), std::get<1>(GetParam())}; }
};
INSTANTIATE_TEST_SUITE_P(Versions, Nifti, testing::Combine(testing::Values(1, 2), testing::Bool()));

TEST_P(Nifti, EveryTypePlainAndCompressed) {
    const Folder folder;
    locus_volume_read_options keep = read_options();
    keep.numbers = LOCUS_READ_KEEP;
    for_every_type([&]<typename T>(uint32_t type, T) {
        Header h = header();
        h.dims({4, 3, 2});
        h.type(codes[type], 8 * sizeof(T));
        const auto numbers = sample<T>(24);
        const std::string file = h.bytes + bytes_of(numbers, h.big);
        for (const std::string &path :
             {folder.write("v.nii", file), folder.write("v.nii.gz", compressed(file, true))}) {
            const Volume volume = read(path, &keep);
            ASSERT_TRUE(volume);
            EXPECT_EQ(bytes_of(numbers_of<T>(volume)), bytes_of(numbers));
            EXPECT_EQ(info_of(volume).type, type);
            EXPECT_EQ(info_of(volume).format, uint32_t{LOCUS_VOLUME_NIFTI});
        }
    });
}

TEST_P(Nifti, SpacingScalingTimeAndExtensions) {
    const Folder folder;
    Header h = header();
    h.dims({2, 1, 1, 2});
    h.type(4, 16);
    h.pixdim(1, 0.5), h.pixdim(2, -2), h.pixdim(3, 0), h.pixdim(4, 7);
    h.scaling(0.5, 10);
    if (h.version == 1)
        h.put<float>(108, 368);
    else
        h.put<int64_t>(168, 560);
    const std::string extension(16, 'x');
    const Volume volume =
        read(folder.write("v.nii", h.bytes + extension + bytes_of(std::vector<int16_t>{-2, 4, 6, 8}, h.big)));
    ASSERT_TRUE(volume);
    const locus_volume_info info = info_of(volume);
    EXPECT_EQ(info.components, 2u);
    EXPECT_EQ(info.spacing[0], 0.5);
    EXPECT_EQ(info.spacing[1], 2.0);
    EXPECT_EQ(info.spacing[2], 1.0);
    EXPECT_EQ(numbers_of<float>(volume), (std::vector<float>{9, 12, 13, 14}));
}

TEST_P(Nifti, SformAndQformBecomeLeftPosteriorSuperior) {
    const Folder folder;
    Header h = header();
    h.dims({1, 1, 1});
    h.type(2, 8);
    for (size_t axis = 1; axis < 4; ++axis)
        h.pixdim(axis, static_cast<double>(axis));
    // qform: half a turn about z (the quaternion (0, 0, 0, 1)), offset (10, 20, 30).
    h.code(252, 344, 1);
    h.real(256, 352, 0), h.real(260, 360, 0), h.real(264, 368, 1);
    h.real(268, 376, 10), h.real(272, 384, 20), h.real(276, 392, 30);
    const locus_volume_info q = info_of(read(folder.write("q.nii", h.bytes + "x")));
    EXPECT_NEAR(q.direction[0], 1, 1e-6); // x to the left: -(-1)
    EXPECT_NEAR(q.direction[4], 1, 1e-6);
    EXPECT_NEAR(q.direction[8], 1, 1e-6);
    EXPECT_NEAR(q.spacing[1], 2, 1e-6);
    EXPECT_NEAR(q.origin[0], -10, 1e-6);
    EXPECT_NEAR(q.origin[2], 30, 1e-6);
    // sform, which goes first: grid x along anterior, y along right, z up.
    h.code(254, 348, 1);
    const double rows[3][4] = {{0, 4, 0, -1}, {3, 0, 0, -2}, {0, 0, 5, -3}};
    for (size_t row = 0; row < 3; ++row)
        for (size_t i = 0; i < 4; ++i)
            h.real(280 + 16 * row + 4 * i, 400 + 32 * row + 8 * i, rows[row][i]);
    const locus_volume_info s = info_of(read(folder.write("s.nii", h.bytes + "x")));
    EXPECT_EQ(s.spacing[0], 3.0);
    EXPECT_EQ(s.spacing[1], 4.0);
    EXPECT_EQ(s.spacing[2], 5.0);
    EXPECT_EQ(s.direction[1], -1.0);
    EXPECT_EQ(s.direction[3], -1.0);
    EXPECT_EQ(s.direction[8], 1.0);
    EXPECT_EQ(s.origin[0], 1.0);
    EXPECT_EQ(s.origin[1], 2.0);
    EXPECT_EQ(s.origin[2], -3.0);
}

TEST_P(Nifti, ColoursAreComponents) {
    const Folder folder;
    Header h = header();
    h.dims({2, 1, 1});
    h.type(128, 24);
    const Volume volume = read(folder.write("v.nii", h.bytes + "abcdef"));
    EXPECT_EQ(info_of(volume).components, 3u);
    EXPECT_EQ(numbers_of<float>(volume), (std::vector<float>{'a', 'd', 'b', 'e', 'c', 'f'}));
}

TEST_P(Nifti, LiesAreNamedAndNothingIsPrinted) {
    const Folder folder;
    const auto refused = [&](auto change, locus_status status, const char *text) {
        Header h = header();
        h.dims({2, 2, 2});
        h.type(2, 8);
        change(h);
        for (const bool packed : {false, true}) {
            const std::string file = h.bytes + "12345678";
            const std::string path = folder.write("v.nii", packed ? compressed(file, true) : file);
            locus_volume *volume = nullptr;
            EXPECT_EQ(locus_volume_read(path.c_str(), nullptr, &volume), status);
            EXPECT_NE(std::string(locus_io_last_error()).find(text), std::string::npos) << locus_io_last_error();
        }
    };
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    refused([](Header &h) { h.dims({2, 2, 3}); }, LOCUS_E_FORMAT, "8");
    refused([](Header &h) { h.dims({2, 2, 1}); }, LOCUS_E_FORMAT, "allow_trailing");
    refused([](Header &h) { h.dims({2, 0, 1}); }, LOCUS_E_FORMAT, "dim[2] is 0");
    refused([](Header &h) { h.dims({-2, 2, 2}); }, LOCUS_E_FORMAT, "dim[1] is -2");
    refused([](Header &h) { h.dims({30000, 30000, 30000}); }, LOCUS_E_FORMAT, "30000 x 30000 x 30000");
    refused([](Header &h) { h.dims({30000, 30000, 30000, 30000, 30000}); }, LOCUS_E_FORMAT, "dim[5] is 30000");
    refused([](Header &h) { h.dims({1, 1, 1, 1, 1, 1, 1, 1}); }, LOCUS_E_FORMAT, "dim[0] is 8");
    refused([](Header &h) { h.type(2, 16); }, LOCUS_E_FORMAT, "bitpix is 16");
    refused([](Header &h) { h.type(1, 1); }, LOCUS_E_FORMAT, "datatype is 1,");
    refused([](Header &h) { h.type(0, 0); }, LOCUS_E_FORMAT, "datatype is 0,");
    refused([](Header &h) { h.type(1792, 128); }, LOCUS_E_UNSUPPORTED, "datatype is 1792 (NIFTI_TYPE_COMPLEX128)");
    refused([](Header &h) { h.type(1536, 128); }, LOCUS_E_UNSUPPORTED, "datatype is 1536");
    refused([](Header &h) { h.type(99, 8); }, LOCUS_E_FORMAT, "datatype is 99");
    refused([](Header &h) { h.pixdim(1, std::nan("")); }, LOCUS_E_FORMAT, "pixdim[1] is nan");
    refused([](Header &h) { h.code(254, 348, 1); }, LOCUS_E_FORMAT, "the sform's column 0 has the length 0");
    refused([](Header &h) { h.bytes.replace(h.version == 1 ? 344 : 4, 2, "ni"); }, LOCUS_E_UNSUPPORTED,
            ".hdr and .img");
    refused([](Header &h) { h.bytes.replace(h.version == 1 ? 344 : 4, 2, "xx"); }, LOCUS_E_FORMAT, "magic");
    refused([](Header &h) { h.version == 1 ? h.put<float>(108, 0) : h.put<int64_t>(168, 0); }, LOCUS_E_FORMAT,
            "vox_offset is 0");
    refused([](Header &h) { h.version == 1 ? h.put<float>(108, NAN) : h.put<int64_t>(168, -1); }, LOCUS_E_FORMAT,
            "vox_offset is ");
    refused([](Header &h) { h.version == 1 ? h.put<float>(108, 1e8f) : h.put<int64_t>(168, 100'000'000); },
            LOCUS_E_FORMAT, "8 bytes");
    refused([](Header &h) { h.bytes.resize(100); }, LOCUS_E_FORMAT, "");
    std::fflush(nullptr);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

// A real one, where the Debian package mricron-data is installed.
TEST(NiftiSample, Brain) {
    const char *path = "/usr/share/mricron/templates/ch2.nii.gz";
    if (::access(path, R_OK) != 0)
        GTEST_SKIP() << "no " << path << " (package mricron-data)";
    const locus_volume_info info = info_of(read(path));
    EXPECT_EQ(info.dims[0], 181u);
    EXPECT_EQ(info.dims[1], 217u);
    EXPECT_EQ(info.dims[2], 181u);
}

} // namespace
