// Bad volume files with text headers: each lie is refused with its status and a text that names the value.
#include "tests/unit/io/volume_files.hpp"

#include <sys/stat.h>

namespace {

using namespace volume_test;

struct Lie {
    const char *name; // of the file
    std::string bytes;
    locus_status status;
    std::string text; // part of the error
};

std::ostream &operator<<(std::ostream &out, const Lie &lie) { return out << lie.text; }

// A good header with one field replaced (or added) by "key = value".
std::string meta(const std::string &key, const std::string &value, const std::string &data = "12345678") {
    std::vector<std::pair<std::string, std::string>> fields{
        {"NDims", "3"}, {"DimSize", "2 2 2"}, {"ElementType", "MET_UCHAR"}, {"ElementDataFile", "LOCAL"}};
    const auto found = std::ranges::find(fields, key, &std::pair<std::string, std::string>::first);
    if (found == fields.end())
        fields.insert(fields.begin(), {key, value});
    else
        found->second = value;
    std::string text;
    for (const auto &[name, given] : fields)
        text += name + " = " + given + "\n";
    return text + data;
}

std::string nrrd(const std::string &field, const std::string &value, const std::string &data = "12345678") {
    std::vector<std::pair<std::string, std::string>> fields{
        {"type", "uint8"}, {"dimension", "3"}, {"sizes", "2 2 2"}, {"encoding", "raw"}};
    const auto found = std::ranges::find(fields, field, &std::pair<std::string, std::string>::first);
    if (found == fields.end())
        fields.emplace_back(field, value);
    else
        found->second = value;
    std::string text = "NRRD0004\n";
    for (const auto &[name, given] : fields)
        text += name + ": " + given + "\n";
    return text + "\n" + data;
}

class Lies : public testing::TestWithParam<Lie> {};

TEST_P(Lies, AreRefusedByName) {
    const Folder folder;
    const std::string path = folder.write(GetParam().name, GetParam().bytes);
    locus_volume *volume = nullptr;
    EXPECT_EQ(locus_volume_read(path.c_str(), nullptr, &volume), GetParam().status) << locus_io_last_error();
    EXPECT_EQ(volume, nullptr);
    const std::string error = locus_io_last_error();
    EXPECT_NE(error.find(GetParam().text), std::string::npos) << error;
    EXPECT_NE(error.find(folder / ""), std::string::npos) << error;
    locus_volume_destroy(volume);
}

constexpr locus_status format = LOCUS_E_FORMAT;
constexpr locus_status unsupported = LOCUS_E_UNSUPPORTED;

INSTANTIATE_TEST_SUITE_P(
    MetaImage, Lies,
    testing::Values(
        Lie{"v.mha", meta("DimSize", "2 2 3"), format, "take 12 bytes, but the file holds 8"},
        Lie{"v.mha", meta("DimSize", "2 2 1"), format, "take 4 bytes, but the file holds 8"},
        Lie{"v.mha", meta("DimSize", "0 2 2"), format, "dims[0] is 0"},
        Lie{"v.mha", meta("DimSize", "-2 2 2"), format, "\"-2\", not a whole number"},
        Lie{"v.mha", meta("DimSize", "2 2"), format, "DimSize is \"2 2\", the wrong count"},
        Lie{"v.mha", meta("DimSize", "2 2 2 2"), format, "the wrong count"},
        Lie{"v.mha", meta("DimSize", "2 2 2e0"), format, "\"2e0\""},
        Lie{"v.mha", meta("DimSize", "18446744073709551616 1 1"), format, "\"18446744073709551616\""},
        Lie{"v.mha", meta("DimSize", "18446744073709551615 2 1"), format, "18446744073709551615 x 2 x 1"},
        Lie{"v.mha", meta("DimSize", "4294967296 4294967296 1"), format, "4294967296 x 4294967296 x 1"},
        Lie{"v.mha", meta("DimSize", "1000000 1000 1000"), format, "take 1000000000000 bytes"},
        Lie{"v.mha", meta("NDims", "0"), format, "NDims is \"0\""},
        Lie{"v.mha", meta("NDims", "9"), unsupported, "NDims is \"9\""},
        Lie{"v.mha", meta("NDims", "x"), format, "NDims is \"x\""},
        Lie{"v.mha", meta("ElementType", "MET_STRING"), unsupported, "\"MET_STRING\""},
        Lie{"v.mha", meta("ElementType", ""), unsupported, "ElementType is \"\""},
        Lie{"v.mha", meta("ElementSpacing", "1 0 1"), format, "spacing[1] is 0"},
        Lie{"v.mha", meta("ElementSpacing", "1 nan 1"), format, "spacing[1] is nan"},
        Lie{"v.mha", meta("ElementSpacing", "1 inf 1"), format, "spacing[1] is inf"},
        Lie{"v.mha", meta("ElementSpacing", "1 1,5 1"), format, "\"1,5\", not a number"},
        Lie{"v.mha", meta("Offset", "1 2 inf"), format, "origin[2] is inf"},
        Lie{"v.mha", meta("TransformMatrix", "1 0 0 0 0 0 0 0 1"), format, "the direction of axis 1 is (0, 0, 0)"},
        Lie{"v.mha", meta("ElementNumberOfChannels", "0"), format, "components is 0"},
        Lie{"v.mha", meta("ElementNumberOfChannels", "99999999"), format, "components is 99999999"},
        Lie{"v.mha", meta("BinaryData", "maybe"), format, "BinaryData is \"maybe\""},
        Lie{"v.mha", meta("BinaryData", "False"), unsupported, "BinaryData"},
        Lie{"v.mha", meta("ObjectType", "Mesh"), unsupported, "\"Mesh\""},
        Lie{"v.mha", meta("HeaderSize", "4"), format, "the file holds 4"},
        Lie{"v.mha", meta("HeaderSize", "18446744073709551615"), format, "the file holds 0"},
        Lie{"v.mha", meta("HeaderSize", "-2"), format, "HeaderSize is \"-2\""},
        Lie{"v.mha", meta("ElementToIntensityFunctionSlope", "0"), format, "slope and intercept are 0 and 0"},
        Lie{"v.mha", "NDims = 3\nNDims = 2\n", format, "NDims is \"2\", a second value"},
        Lie{"v.mha", "NDims = 3\nDimSize = 2 2 2\n", format, "no field \"ElementDataFile\""},
        Lie{"v.mha", "NDims = 3\nElementDataFile = LOCAL\n", format, "no field \"ElementType\""},
        Lie{"v.mha", "one two\n", format, "\"one two\""}, Lie{"v.mha", "", format, "no field"},
        Lie{"v.mha", meta("CompressedData", "True"), format, "compressed data are damaged"},
        Lie{"v.mha", meta("CompressedData", "True", compressed("1234567", false)), format, "after 7 of 8 bytes"},
        Lie{"v.mha", meta("CompressedData", "True", compressed("123456789", false)), format, "longer than the 8 bytes"},
        Lie{"v.mha", meta("CompressedData", "True", compressed("12345678", false).substr(0, 9)), format, "of 8 bytes"},
        Lie{"v.mha", meta("CompressedData", "True", compressed("12345678", false).substr(0, 14)), format,
            "before their checksum"},
        Lie{"v.mha", meta("CompressedData", "True", ""), format, "the data end after 0 of 8 bytes"},
        Lie{"v.mha", meta("CompressedData = True\nCompressedDataSize", "99", compressed("12345678", false)), format,
            "are 99 bytes by the header"},
        Lie{"v.mha", "CompressedData = True\n" + meta("DimSize", "10000 10000 10000"), format,
            "8 compressed bytes cannot hold"},
        Lie{"v.mhd", meta("ElementDataFile", "absent.raw", ""), LOCUS_E_IO, "absent.raw: cannot open: No such file"},
        Lie{"v.mhd", meta("ElementDataFile", "/etc/passwd", ""), format, "\"/etc/passwd\" lies outside"},
        Lie{"v.mhd", meta("ElementDataFile", "../../v.raw", ""), format, "\"../../v.raw\" lies outside"},
        Lie{"v.mhd", meta("ElementDataFile", "a/../../v.raw", ""), format, "lies outside"},
        Lie{"v.mhd", meta("ElementDataFile", "..", ""), format, "lies outside"},
        Lie{"v.mhd", meta("ElementDataFile", ".", ""), LOCUS_E_IO, "not a regular file"},
        Lie{"v.mhd", meta("ElementDataFile", "", ""), format, "the name of the data file is empty"},
        Lie{"v.mhd", meta("ElementDataFile", "slice%03d.raw 1 9 1", ""), unsupported, "one file per slice"},
        Lie{"v.mhd", meta("ElementDataFile", "LIST", ""), unsupported, "one file per slice"}));

INSTANTIATE_TEST_SUITE_P(
    Nrrd, Lies,
    testing::Values(
        Lie{"v.nrrd", "NRRD0009\n", unsupported, "\"NRRD0009\""},
        Lie{"v.nrrd", "NRRD0004\ntype: uint8\n", format, "no end"},
        Lie{"v.nrrd", "NRRD0004\ntype: uint8\n\n", format, "no field \"dimension\""},
        Lie{"v.nrrd", "NRRD0004\nnonsense\n\n", format, "\"nonsense\""},
        Lie{"v.nrrd", nrrd("sizes", "2 2 3"), format, "take 12 bytes, but the file holds 8"},
        Lie{"v.nrrd", nrrd("sizes", "2 2 1"), format, "take 4 bytes, but the file holds 8"},
        Lie{"v.nrrd", nrrd("sizes", "2 2"), format, "the wrong count"},
        Lie{"v.nrrd", nrrd("sizes", "2 0 2"), format, "dims[1] is 0"},
        Lie{"v.nrrd", nrrd("sizes", "1099511627776 1 1"), format, "1099511627776 x 1 x 1"},
        Lie{"v.nrrd", nrrd("dimension", "17"), unsupported, "dimension is \"17\""},
        Lie{"v.nrrd", nrrd("dimension", "0"), format, "dimension is \"0\""},
        Lie{"v.nrrd", nrrd("dimension", "2"), format, "the wrong count"},
        Lie{"v.nrrd", nrrd("type", "block"), unsupported, "\"block\""},
        Lie{"v.nrrd", nrrd("type", "short"), format, "no field \"endian\""},
        Lie{"v.nrrd", nrrd("encoding", "ascii"), unsupported, "\"ascii\""},
        Lie{"v.nrrd", nrrd("encoding", "bzip2"), unsupported, "\"bzip2\""},
        Lie{"v.nrrd", nrrd("encoding", "gzip"), format, "compressed data are damaged"},
        Lie{"v.nrrd", nrrd("encoding", "gzip", compressed("1234567", true)), format, "after 7 of 8 bytes"},
        Lie{"v.nrrd", nrrd("spacings", "1 1 -1"), format, "spacing[2] is -1"},
        Lie{"v.nrrd", nrrd("spacings", "1 1"), format, "spacings is \"1 1\""},
        Lie{"v.nrrd", nrrd("kinds", "domain domain"), format, "not one per axis"},
        Lie{"v.nrrd", nrrd("kinds", "domain list domain"), unsupported, "neither first nor last"},
        Lie{"v.nrrd", nrrd("kinds", "list domain list"), unsupported, "more than one axis outside space"},
        Lie{"v.nrrd", nrrd("space directions", "(1,0,0) (0,1,0)"), format, "not one per axis"},
        Lie{"v.nrrd", nrrd("space directions", "(1,0,0) (0,1,0) (0,0,0)"), format, "a vector has no length"},
        Lie{"v.nrrd", nrrd("space directions", "(1,0,0) (0,1,0) (0,0,nan)"), format, "a vector has no length"},
        Lie{"v.nrrd", nrrd("space directions", "(1,0,0) (0,1,0) (0,0"), format, "not vectors"},
        Lie{"v.nrrd", nrrd("space directions", "(1,0) (0,1) none"), unsupported, "not vectors of three"},
        Lie{"v.nrrd", nrrd("space origin", "1 2 3"), format, "space origin is \"1 2 3\""},
        Lie{"v.nrrd", nrrd("space", "LPST-time"), unsupported, "a space with time"},
        Lie{"v.nrrd", nrrd("byte skip", "9"), format, "the file holds 0"},
        Lie{"v.nrrd", nrrd("byte skip", "-3"), format, "byte skip is \"-3\""},
        Lie{"v.nrrd", nrrd("line skip", "2"), format, "fewer lines"},
        Lie{"v.nrrd", nrrd("sizes", "2 2 2\nsizes: 1 1 1"), format, "a second value"},
        Lie{"v.nhdr", nrrd("data file", "gone.raw"), LOCUS_E_IO, "gone.raw: cannot open"},
        Lie{"v.nhdr", nrrd("data file", "../v.raw"), format, "\"../v.raw\" lies outside"},
        Lie{"v.nhdr", nrrd("datafile", "LIST"), unsupported, "one file per slice"},
        Lie{"v.nhdr", nrrd("data file", "a%d.raw 1 2 1"), unsupported, "one file per slice"}));

INSTANTIATE_TEST_SUITE_P(Unknown, Lies,
                         testing::Values(Lie{"v.dat", "", format, "the file is empty"},
                                         Lie{"v.dat", std::string(100, '\0'), format, "no known format"},
                                         Lie{"v.nii.gz", "\x1f\x8b nonsense", format, "compressed data are damaged"}));

TEST(VolumeLies, APipeDoesNotHang) {
    const Folder folder;
    const std::string pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    locus_volume *volume = nullptr;
    EXPECT_EQ(locus_volume_read(pipe.c_str(), nullptr, &volume), LOCUS_E_IO);
    EXPECT_EQ(locus_volume_read((folder / "").c_str(), nullptr, &volume), LOCUS_E_IO);
}

TEST(VolumeLies, RawOptionsAreNamed) {
    const Folder folder;
    const std::string path = folder.write("v.raw", "12345678");
    const auto refused = [&](auto change, locus_status status, const char *text) {
        locus_volume_read_options options = read_options();
        options.format = LOCUS_VOLUME_RAW;
        options.raw_type = LOCUS_VOXEL_UINT8;
        for (uint64_t &dim : options.raw_dims)
            dim = 2;
        change(options);
        locus_volume *volume = nullptr;
        EXPECT_EQ(locus_volume_read(path.c_str(), &options, &volume), status);
        EXPECT_NE(std::string(locus_io_last_error()).find(text), std::string::npos) << locus_io_last_error();
    };
    refused([](auto &o) { o.raw_dims[2] = 0; }, LOCUS_E_ARGUMENT, "raw_dims[2] is 0");
    refused([](auto &o) { o.raw_dims[2] = 3; }, LOCUS_E_FORMAT, "take 12 bytes");
    refused([](auto &o) { o.raw_type = 0; }, LOCUS_E_ARGUMENT, "raw_type is 0");
    refused([](auto &o) { o.raw_components = 0; }, LOCUS_E_ARGUMENT, "raw_components is 0");
    refused([](auto &o) { o.raw_offset = UINT64_MAX; }, LOCUS_E_FORMAT, "holds 0 behind");
    refused([](auto &o) { o.raw_spacing[1] = -1; }, LOCUS_E_ARGUMENT, "raw_spacing[1] is -1");
    refused([](auto &o) { o.format = 5; }, LOCUS_E_ARGUMENT, "format is 5");
    refused([](auto &o) { o.numbers = 2; }, LOCUS_E_ARGUMENT, "numbers is 2");
    refused([](auto &o) { o.memory_limit = 0; }, LOCUS_E_ARGUMENT, "memory_limit is 0");
    refused([](auto &o) { o.struct_size = 1; }, LOCUS_E_ARGUMENT, "struct_size is 1");
}

} // namespace
