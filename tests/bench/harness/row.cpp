// Rows as JSON and as text.
#include "tests/bench/harness/row.hpp"

#include "tests/bench/harness/machine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bench {
namespace {

std::string quoted(const std::string &text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
        }
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return out + '"';
}

std::string number(double value) {
    if (!std::isfinite(value)) {
        return "null";
    }
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

template <class Map, class Value>
std::string object(const Map &map, Value value) {
    std::string out = "{";
    for (const auto &[name, entry] : map) {
        out += (out.size() > 1 ? ", " : "") + quoted(name) + ": " + number(value(name, entry));
    }
    return out + "}";
}

} // namespace

Spread spread(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    const double median = n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
    return {median, values.front(), values.back(), n};
}

void Row::check(bool holds, const std::string &what) {
    ++checks;
    if (!holds) {
        failures.push_back(what);
    }
}

std::string Row::json() const {
    const auto same = [](const std::string &, double value) { return value; };
    std::string out = "{\"case\": " + quoted(name) + ", \"unit\": " + quoted(unit) +
                      ", \"ours\": " + number(ours.median) + ", \"min\": " + number(ours.min) +
                      ", \"max\": " + number(ours.max) + ", \"runs\": " + std::to_string(ours.runs) +
                      ", \"threads\": " + std::to_string(threads) + ", \"peers\": ";
    out += object(peers, [](const std::string &, const Spread &peer) { return peer.median; });
    out += ", \"ratio\": ";
    out += object(peers, [&](const std::string &peer, const Spread &) { return ratio(peer); });
    out += ", \"peer_min\": ";
    out += object(peers, [](const std::string &, const Spread &peer) { return peer.min; });
    if (!goals.empty()) {
        out += ", \"goals\": " + object(goals, same);
    }
    out += std::string(", \"checked\": ") + (checked() ? "true" : "false");
    if (quick) {
        out += ", \"quick\": true";
    }
    out += std::string(", \"huge_pages\": ") + (huge_pages ? "true" : "false");
    out += ", \"cpu\": " + quoted(cpu_name()) + ", \"target\": " + quoted(target) +
           ", \"backend\": " + quoted(backend) + ", \"commit\": " + quoted(commit());
    for (const auto &[key, value] : extras) {
        out += ", " + quoted(key) + ": " + number(value);
    }
    return out + "}";
}

std::string Row::heading() {
    char text[160];
    std::snprintf(text, sizeof text, "%-38s %12s %10s %10s %-9s %2s  %s", "case", "ours", "min", "max", "unit", "T",
                  "peers: how many times ours (goal)");
    return text;
}

std::string Row::line() const {
    char text[200];
    std::snprintf(text, sizeof text, "%-38s %12.5g %10.4g %10.4g %-9s %2u ", name.c_str(), ours.median, ours.min,
                  ours.max, unit.c_str(), threads);
    std::string out = text;
    for (const auto &[peer, entry] : peers) {
        std::snprintf(text, sizeof text, " %s %.3gx", peer.c_str(), ratio(peer));
        out += text;
        if (const auto goal = goals.find(peer); goal != goals.end()) {
            std::snprintf(text, sizeof text, " (%.3g)", goal->second);
            out += text;
        }
    }
    if (!checked()) {
        out += "  NOT CHECKED";
    }
    return out + (quick ? "  quick" : "");
}

} // namespace bench
