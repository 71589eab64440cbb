// locus/storage.hpp: stores on disk as C++ objects.
#include <gtest/gtest.h>

#include <locus/locus.hpp>

#include <filesystem>

#include <unistd.h>

namespace {

const int64_t noon = int64_t{1700000000} * 1000000;

struct CppStorage : testing::Test {
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("locus-cpp-storage-" + std::to_string(::getpid()));
    void SetUp() override { std::filesystem::create_directories(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string path(const char *name) const { return (folder / name).string(); }
};

std::vector<locus_point32> posts(size_t count) {
    std::vector<locus_point32> records(count);
    for (size_t i = 0; i < count; ++i)
        records[i] = {double(i % 90), double(i % 170), noon + int64_t(i), 0, 0, 0, uint16_t(i)};
    return records;
}

TEST_F(CppStorage, FilesComeBack) {
    locus::pmq<> store;
    store.insert(posts(1000), noon + 1000);
    const locus::snapshot moment = store.snapshot();
    store.insert(posts(500), noon + 2000);
    locus::save(store, path("now"));
    locus::save(store, path("before"), {}, &moment);
    EXPECT_EQ(locus::file_info(path("now")).records, 1500u);
    EXPECT_EQ(locus::load(path("now")).count(), 1500u);
    EXPECT_EQ(locus::load(path("before")).count(), 1000u);
    locus::status status;
    EXPECT_FALSE(locus::load<locus_text156>(path("now"), {}, {}, &status));
    EXPECT_EQ(status.code(), LOCUS_E_ARGUMENT);
    EXPECT_FALSE(locus::load(path("none"), {}, {}, &status));
    EXPECT_EQ(status.code(), LOCUS_E_IO);
    EXPECT_THROW(locus::save(store, path("now"), [](double) { throw 5; }), int);
    EXPECT_EQ(locus::file_info(path("now")).records, 1500u);
}

TEST_F(CppStorage, FoldersRecover) {
    {
        auto store = locus::open<>(path("folder"));
        store.insert(posts(100), noon + 1000);
        EXPECT_EQ(locus::log_stats(store).changes, 1u);
        locus::sync(store);
        locus::checkpoint(store);
        store.insert(posts(10), noon + 2000);
    }
    locus_pmq_recovery recovery{};
    size_t gone = 0;
    locus::pmq_options<> options;
    options.sink = [&](const locus_point32 &) { ++gone; };
    auto store = locus::open(path("folder"), options, {}, {}, &recovery);
    EXPECT_EQ(recovery.saved, 100u);
    EXPECT_EQ(recovery.inserted, 10u);
    EXPECT_EQ(store.count(), 110u);
    store.erase({});
    EXPECT_EQ(gone, 110u);
    locus::pmq<> plain;
    EXPECT_THROW(locus::attach(plain, path("folder")), locus::error);
    locus::attach(plain, path("other"));
    EXPECT_EQ(locus::log_stats(plain).attached, 1u);
}

} // namespace
