// The transfer tables of the volume program.
#include "volume/transfer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using volume::TransferTable;

TransferTable table(const std::string &text) { return TransferTable::parse(text, "table"); }

TEST(TransferTable, ACurveIsLinearBetweenItsPointsAndEndsWithThem) {
    const TransferTable curve = table("point 1 20000\npoint 254 5000 # fat\n\n");
    EXPECT_FLOAT_EQ(curve.stiffness(1), 20000);
    EXPECT_FLOAT_EQ(curve.stiffness(254), 5000);
    EXPECT_NEAR(curve.stiffness(128), 20000 - 15000.0 * 127 / 253, 1e-2);
    EXPECT_TRUE(std::isnan(curve.stiffness(0.5f)));
    EXPECT_TRUE(std::isnan(curve.stiffness(255)));
    EXPECT_TRUE(std::isnan(curve.stiffness(std::nanf(""))));
}

TEST(TransferTable, LabelsAndRangesGoBeforeTheCurveInTheirOrder) {
    const TransferTable mixed =
        table("point -10 1; point 10 1; label 3 7; range 2 5 9; range -inf -5 none; range 4 inf 8");
    EXPECT_EQ(mixed.stiffness(3), 7);
    EXPECT_EQ(mixed.stiffness(2), 9);
    EXPECT_EQ(mixed.stiffness(4.5f), 9);
    EXPECT_EQ(mixed.stiffness(5), 8);
    EXPECT_EQ(mixed.stiffness(1e30f), 8);
    EXPECT_TRUE(std::isnan(mixed.stiffness(std::numeric_limits<float>::infinity()))); // TO is not included
    EXPECT_EQ(mixed.stiffness(-5), 1);
    EXPECT_TRUE(std::isnan(mixed.stiffness(-5.5f)));
    EXPECT_TRUE(std::isnan(mixed.stiffness(std::nanf(""))));
}

TEST(TransferTable, AStretchBesideNoneIsImpassable) {
    const TransferTable curve = table("point 0 none; point 1 5; point 2 5");
    EXPECT_TRUE(std::isnan(curve.stiffness(0.5f)));
    EXPECT_EQ(curve.stiffness(1), 5);
    EXPECT_EQ(curve.stiffness(1.5f), 5);
}

TEST(TransferTable, BadEntriesAreNamed) {
    const auto refused = [](const std::string &text, const std::string &words) {
        try {
            table(text);
            ADD_FAILURE() << text;
        } catch (const std::runtime_error &error) {
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    };
    refused("", "no entry");
    refused("# nothing", "no entry");
    refused("label 1", "entry 1: label takes 2 words");
    refused("label 1 2; range 3 2 1", "entry 2: the range does not end behind its beginning");
    refused("label x 2", "\"x\" is not a number");
    refused("label nan 2", "\"nan\" is not a number");
    refused("label 1 0", "the stiffness \"0\"");
    refused("label 1 inf", "the stiffness \"inf\"");
    refused("point 1 2; point 1 3", "does not lie behind");
    refused("between 1 2 3", "\"between\" is none of");
    EXPECT_THROW(TransferTable::read("/nonexistent/table"), std::runtime_error);
}

} // namespace
