// locus/volume.hpp and locus/records.hpp: files as C++ objects.
#include <gtest/gtest.h>

#include <locus/records.hpp>
#include <locus/volume.hpp>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace {

struct CppIo : testing::Test {
    std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                   ("locus-cpp-" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) +
                                    "-" + std::to_string(::getpid()));
    void SetUp() override { std::filesystem::create_directories(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string path(const char *name) const { return (folder / name).string(); }
    void write(const char *name, const char *text) const { std::ofstream(path(name)) << text; }
};

TEST_F(CppIo, VolumesComeBack) {
    static_assert(locus::voxel_type<uint8_t>() == LOCUS_VOXEL_UINT8 && locus::voxel_type<int8_t>() == LOCUS_VOXEL_INT8);
    static_assert(locus::voxel_type<int16_t>() == LOCUS_VOXEL_INT16 && locus::voxel_type<uint16_t>() == 3);
    static_assert(locus::voxel_type<uint32_t>() == 5 && locus::voxel_type<int64_t>() == LOCUS_VOXEL_INT64);
    static_assert(locus::voxel_type<float>() == LOCUS_VOXEL_FLOAT32 && locus::voxel_type<double>() == 10);
    locus::volume_info info;
    info.dims[0] = 3, info.dims[1] = 2, info.dims[2] = 1;
    info.spacing[2] = 2.5;
    const std::vector<int16_t> numbers = {1, -2, 3, -4, 5, -6};
    locus::write_volume(path("a.mha"), info, locus::span<const int16_t>(numbers));
    const locus::volume_info known = locus::read_volume_info(path("a.mha"));
    EXPECT_EQ(known.dims[0], 3u);
    EXPECT_EQ(known.spacing[2], 2.5);
    locus::volume_read_options keep;
    keep.numbers = LOCUS_READ_KEEP;
    const locus::volume volume(path("a.mha"), keep);
    const auto data = volume.data<int16_t>();
    EXPECT_TRUE(std::equal(data.begin(), data.end(), numbers.begin(), numbers.end()));
    EXPECT_THROW(volume.data<float>(), locus::error);
    EXPECT_EQ(locus::volume(path("a.mha")).data()[5], -6.0F);
    EXPECT_THROW(locus::write_volume(path("b.mha"), info, locus::span<const float>()), locus::error);
    locus::status status;
    EXPECT_FALSE(locus::volume(path("none.mha"), {}, &status));
    EXPECT_EQ(status.code(), LOCUS_E_IO);
    EXPECT_NE(status.text().find("none.mha"), std::string::npos) << status.text();
    EXPECT_TRUE(locus::volume().data(&status).empty());
    EXPECT_EQ(status.code(), LOCUS_E_ARGUMENT);
}

TEST_F(CppIo, RecordsComeOut) {
    write("posts.csv", "when,lat,lon,text\n1700000000,48.5,2.25,Bonjour\nnever,1,2,bad\n1700000001,-1,3,Hello\n");
    locus::records_options<> options;
    options.time_column = "when";
    std::vector<uint64_t> bad;
    options.bad_line = [&](uint64_t line, std::string_view reason) {
        EXPECT_FALSE(reason.empty());
        bad.push_back(line);
    };
    locus::records<> reader(path("posts.csv"), options);
    const auto posts = reader.next(10);
    ASSERT_EQ(posts.size(), 2u);
    EXPECT_STREQ(posts[0].text, "Bonjour");
    const int64_t time = posts[1].time; // a field of a packed struct: no reference may bind to it
    EXPECT_EQ(time, int64_t{1700000001} * 1000000);
    EXPECT_EQ(bad, (std::vector<uint64_t>{3}));
    EXPECT_TRUE(reader.next(10).empty());
    EXPECT_EQ(reader.stats().bad, 1u);
    options.bad_line = [](uint64_t, std::string_view) { throw 5; };
    locus::records<> throwing(path("posts.csv"), options);
    EXPECT_THROW(throwing.next(10), int);
    locus::status status;
    const locus::records<locus_point32> none(path("none.csv"), {}, &status);
    EXPECT_TRUE(!none && status.code() == LOCUS_E_IO);
    std::FILE *file = std::fopen(path("posts.csv").c_str(), "r");
    locus::records_options<locus_point32> points;
    points.time_column = "when";
    locus::records<locus_point32> from_fd(fileno(file), "posts", points);
    EXPECT_EQ(from_fd.next(1).at(0).latitude, 48.5);
    std::fclose(file);
}

} // namespace
