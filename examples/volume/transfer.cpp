// Parsing and evaluating transfer tables.
#include "volume/transfer.hpp"

#include "volume/text.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace volume {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double value_of(const std::string &word) {
    const auto value = number<double>(word);
    if (!value || std::isnan(*value))
        throw std::runtime_error("\"" + word + "\" is not a number");
    return *value;
}

double stiffness_number(const std::string &text) {
    if (text == "none")
        return none;
    const double value = value_of(text);
    if (!(value > 0) || !std::isfinite(value))
        throw std::runtime_error("the stiffness \"" + text + "\" is neither a number above 0 nor \"none\"");
    return value;
}

} // namespace

TransferTable TransferTable::parse(const std::string &text, const std::string &where) {
    TransferTable table;
    std::string lines = text;
    std::ranges::replace(lines, ';', '\n');
    std::istringstream input(lines);
    std::string line;
    for (int count = 1; std::getline(input, line); ++count) {
        try {
            table.add(line);
        } catch (const std::runtime_error &error) {
            throw std::runtime_error(where + ", entry " + std::to_string(count) + ": " + error.what());
        }
    }
    if (table.ranges_.empty() && table.curve_.empty())
        throw std::runtime_error(where + ": the table has no entry");
    return table;
}

TransferTable TransferTable::read(const std::string &path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file)
        throw std::runtime_error(path + ": cannot read the transfer table");
    return parse(text.str(), path);
}

void TransferTable::add(const std::string &line) {
    const std::vector<std::string> entry = words(line);
    if (entry.empty())
        return;
    const size_t wanted = entry[0] == "range" ? 4 : entry[0] == "point" || entry[0] == "label" ? 3 : 0;
    if (wanted == 0)
        throw std::runtime_error("\"" + entry[0] + "\" is none of point, label, range");
    if (entry.size() != wanted)
        throw std::runtime_error(entry[0] + " takes " + std::to_string(wanted - 1) + " words");
    const double value = value_of(entry[1]);
    const double stiffness = stiffness_number(entry.back());
    if (entry[0] == "point") {
        if (!curve_.empty() && value <= curve_.back().first)
            throw std::runtime_error("the point at " + entry[1] + " does not lie behind the one before");
        curve_.emplace_back(value, stiffness);
        return;
    }
    const double to = entry[0] == "label" ? value : value_of(entry[2]);
    if (entry[0] == "range" && value >= to)
        throw std::runtime_error("the range does not end behind its beginning");
    ranges_.push_back({value, to, stiffness});
}

float TransferTable::stiffness(float value) const {
    for (const Range &range : ranges_)
        if (value == range.from ? true : value > range.from && value < range.to)
            return static_cast<float>(range.stiffness);
    return static_cast<float>(on_curve(value));
}

double TransferTable::on_curve(double value) const {
    if (curve_.empty() || !(value >= curve_.front().first && value <= curve_.back().first))
        return none;
    const auto right = std::ranges::lower_bound(curve_, value, {}, &std::pair<double, double>::first);
    if (right->first == value)
        return right->second;
    const auto left = right - 1; // a "none" at either end makes the stretch between impassable
    const double part = (value - left->first) / (right->first - left->first);
    return left->second + part * (right->second - left->second);
}

} // namespace volume
