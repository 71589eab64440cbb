// The views of the stream example against plain arithmetic, its window, and animated PNGs.
#include "common/animation.hpp"
#include "common/random.hpp"
#include "stream/heat_map.hpp"
#include "stream/window.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <png.h>

namespace {

using namespace demo;

locus_text156 post(double latitude, double longitude, int64_t time) {
    return {static_cast<float>(latitude), static_cast<float>(longitude), time, {}};
}

std::vector<locus_text156> scattered(size_t count) {
    Random random(3);
    std::vector<locus_text156> posts;
    for (size_t i = 0; i < count; ++i)
        posts.push_back(post(170 * random.uniform() - 85, 360 * random.uniform() - 180, static_cast<int64_t>(i)));
    return posts;
}

// The pixels of a view by the key of each record alone.
std::vector<uint32_t> counted(const View &view, const std::vector<locus_text156> &posts) {
    std::vector<uint32_t> counts(static_cast<size_t>(view.width) * static_cast<size_t>(view.height));
    const int64_t world = int64_t{1} << view.level;
    for (const locus_text156 &one : posts) {
        uint64_t key = 0;
        EXPECT_EQ(locus_pmq_key(one.latitude, one.longitude, &key), LOCUS_OK);
        int64_t x = 0, y = 0;
        for (int bit = 24; bit >= 25 - static_cast<int>(view.level); --bit) {
            x = 2 * x + static_cast<int64_t>(key >> (2 * bit) & 1);
            y = 2 * y + static_cast<int64_t>(key >> (2 * bit + 1) & 1);
        }
        const int64_t column = ((x - view.left) % world + world) % world, row = y - view.top;
        if (column < view.width && row >= 0 && row < view.height)
            ++counts[static_cast<size_t>(row * view.width + column)];
    }
    return counts;
}

TEST(HeatMap, CountsEveryRecordOnItsPixel) {
    Window window(int64_t{1} << 40);
    const auto posts = scattered(20'000);
    window.insert(posts);
    for (const View &view :
         {world_view(10), zoom_view({48, 11}, 4000, 300, 200), zoom_view({-17, 179.9}, 3000, 320, 240),
          zoom_view({84, -180}, 1000, 300, 300), zoom_view({0, 0}, 30'000, 256, 256)})
        EXPECT_EQ(counts_of(view, window.store()), counted(view, posts)) << view.level;
}

TEST(View, PixelsAndPositionsAgree) {
    const View view = zoom_view({48.2, 16.4}, 500, 800, 600);
    EXPECT_GE(view.pixel_km() * view.width, 495);
    EXPECT_LE(view.pixel_km() * view.width, 1010);
    EXPECT_NEAR(view.x(16.4), 400, 1);
    EXPECT_NEAR(view.y(48.2), 300, 1);
    const Position position = view.position(123, 456);
    EXPECT_NEAR(view.x(position.longitude), 123, 1e-6);
    EXPECT_NEAR(view.y(position.latitude), 456, 1e-6);
    const locus_box box = box_of(zoom_view({-17, 179.9}, 3000, 320, 240));
    EXPECT_GT(box.west, box.east); // across the antimeridian
    const locus_box whole = box_of(world_view(10));
    EXPECT_EQ(whole.west, -180);
    EXPECT_EQ(whole.east, 180);
}

TEST(Window, AFewTimesFarAheadDoNotEmptyIt) {
    constexpr int64_t hour = 3'600'000'000;
    Window window(6 * hour);
    std::vector<locus_text156> batch;
    for (int64_t i = 0; i < 100; ++i)
        batch.push_back(post(1, 2, 1000 * hour + i));
    batch[50].time = 90'000 * hour;
    window.insert(batch);
    EXPECT_EQ(window.clock(), 1000 * hour + 99);
    EXPECT_EQ(window.ahead(), 1u);
    EXPECT_EQ(window.stats().records, 100u);

    for (auto &one : batch)
        one.time = 900 * hour; // times run back: the clock does not
    window.insert(batch);
    EXPECT_EQ(window.clock(), 1000 * hour + 99);
    EXPECT_EQ(window.late(), 100u);
    EXPECT_EQ(window.stats().records, 100u);

    for (int64_t i = 0; i < 100; ++i)
        batch[static_cast<size_t>(i)].time = (1100 + i * 24) * hour; // sparse, not slips
    window.insert(batch);
    EXPECT_EQ(window.clock(), (1100 + 99 * 24) * hour);
    EXPECT_EQ(window.ahead(), 1u);
}

TEST(Animation, IsAPngWithAllFrames) {
    Animation animation;
    EXPECT_THROW(animation.write("/tmp/never.png", 100), std::runtime_error);
    const std::string path = testing::TempDir() + "animation.png";
    Canvas red(30, 20, {255, 0, 0}), green(30, 20, {0, 255, 0});
    for (const Canvas *canvas : {&red, &green, &red})
        animation.add(encode_png(*canvas));
    EXPECT_THROW(animation.add(encode_png(Canvas(31, 20))), std::runtime_error);
    animation.write(path, 100);
    // A reader without animation sees the first frame, with all checksums verified.
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0) << image.message;
    image.format = PNG_FORMAT_RGB;
    std::vector<uint8_t> pixels(PNG_IMAGE_SIZE(image));
    ASSERT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0) << image.message;
    EXPECT_EQ(pixels[0], 255);
    EXPECT_EQ(pixels[1], 0);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    size_t controls = 0, frames = 0;
    for (size_t at = 0; (at = bytes.find("fcTL", at)) != std::string::npos; ++at)
        ++controls;
    for (size_t at = 0; (at = bytes.find("fdAT", at)) != std::string::npos; ++at)
        ++frames;
    EXPECT_EQ(controls, 3u);
    EXPECT_EQ(frames, 2u);
}

TEST(WriteFile, WholeOrNotAtAll) {
    EXPECT_THROW(write_file("/nowhere/at/all.png", "x", 1), std::runtime_error);
    const std::string path = testing::TempDir() + "whole.txt";
    write_file(path, "whole", 5);
    std::ifstream file(path);
    std::string text;
    file >> text;
    EXPECT_EQ(text, "whole");
}

} // namespace
