// Writing volumes: what is refused, and what is on the disk after a failure.
#include "tests/unit/io/volume_files.hpp"

#include <csignal>
#include <limits>
#include <sys/resource.h>

namespace {

using namespace volume_test;

// Files of this process may not grow beyond `bytes`: writing behind them fails as on a full disk.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    void (*handler_)(int);
    rlimit before_{};
};

TEST(VolumeWrite, AFullDiskLeavesTheOlderFileAndNothingElse) {
    const Folder folder;
    const locus_volume_info info = make_info(64, 64, 64, LOCUS_VOXEL_UINT8);
    const auto numbers = sample<uint8_t>(count_of(info));
    for (const char *name : {"v.mha", "v.mhd", "v.nrrd", "v.nhdr"}) {
        const std::string path = folder.write(name, "older");
        locus_status status = LOCUS_OK;
        {
            const FileSizeLimit limit(100'000);
            status = locus_volume_write(path.c_str(), &info, numbers.data(), nullptr);
        }
        EXPECT_EQ(status, LOCUS_E_IO);
        EXPECT_NE(std::string(locus_io_last_error()).find("cannot write"), std::string::npos) << locus_io_last_error();
        EXPECT_EQ(content(path), "older");
    }
    EXPECT_EQ(folder.names().size(), 4u);
}

TEST(VolumeWrite, AMissingFolderIsAnErrorThatNamesIt) {
    const Folder folder;
    const locus_volume_info info = make_info(1, 1, 1, LOCUS_VOXEL_UINT8);
    const uint8_t number = 1;
    EXPECT_EQ(locus_volume_write((folder / "absent/v.mha").c_str(), &info, &number, nullptr), LOCUS_E_IO);
    EXPECT_NE(std::string(locus_io_last_error()).find("absent/v.mha"), std::string::npos);
}

TEST(VolumeWrite, ReplacesAnOlderFile) {
    const Folder folder;
    const locus_volume_info info = make_info(1, 1, 1);
    float number = 1;
    for (; number < 3; ++number)
        ASSERT_EQ(locus_volume_write((folder / "v.nrrd").c_str(), &info, &number, nullptr), LOCUS_OK);
    EXPECT_EQ(numbers_of<float>(read(folder / "v.nrrd")), std::vector<float>{2});
    EXPECT_EQ(folder.names().size(), 1u);
}

TEST(VolumeWrite, BadArgumentsAreNamed) {
    const Folder folder;
    const std::string path = folder / "v.mha";
    const float number = 1;
    const auto refused = [&](const locus_volume_info &info, const char *text) {
        EXPECT_EQ(locus_volume_write(path.c_str(), &info, &number, nullptr), LOCUS_E_ARGUMENT);
        EXPECT_NE(std::string(locus_io_last_error()).find(text), std::string::npos) << locus_io_last_error();
    };
    const auto changed = [](auto change) {
        locus_volume_info info = make_info(1, 1, 1);
        change(info);
        return info;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    refused(changed([](auto &i) { i.dims[1] = 0; }), "dims[1] is 0");
    refused(changed([](auto &i) { i.dims[0] = i.dims[2] = uint64_t{1} << 33; }), "8589934592 x 1 x 8589934592");
    refused(changed([](auto &i) { i.components = 0; }), "components is 0");
    refused(changed([](auto &i) { i.components = uint64_t{1} << 60; }), "components is 1152921504606846976");
    refused(changed([](auto &i) { i.spacing[2] = -1; }), "spacing[2] is -1");
    refused(changed([&](auto &i) { i.origin[0] = nan; }), "origin[0] is nan");
    refused(changed([](auto &i) { i.direction[0] = 3; }), "axis 0 is (3, 0, 0)");
    refused(changed([](auto &i) { i.type = 99; }), "type 99");
    refused(changed([](auto &i) { i.slope = 2; }), "slope and intercept are 2 and 0");
    refused(changed([](auto &i) { i.struct_size = 8; }), "struct_size is 8");

    const locus_volume_info info = make_info(1, 1, 1);
    EXPECT_EQ(locus_volume_write((folder / "v.png").c_str(), &info, &number, nullptr), LOCUS_E_ARGUMENT);
    EXPECT_NE(std::string(locus_io_last_error()).find("v.png"), std::string::npos);
    EXPECT_EQ(locus_volume_write(path.c_str(), &info, nullptr, nullptr), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_volume_write(path.c_str(), nullptr, &number, nullptr), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_volume_write(nullptr, &info, &number, nullptr), LOCUS_E_ARGUMENT);
    EXPECT_STREQ(locus_io_last_error(), "locus_volume_write: path is NULL");
    locus_volume_write_options options;
    ASSERT_EQ(locus_volume_write_options_init(&options, sizeof options), LOCUS_OK);
    options.compression = 10;
    EXPECT_EQ(locus_volume_write(path.c_str(), &info, &number, &options), LOCUS_E_ARGUMENT);
    options.compression = 0, options.format = LOCUS_VOLUME_NIFTI;
    EXPECT_EQ(locus_volume_write(path.c_str(), &info, &number, &options), LOCUS_E_ARGUMENT);
    EXPECT_TRUE(folder.names().empty());
}

} // namespace
