// Words and readable numbers.
#include "volume/text.hpp"

#include <cmath>
#include <cstdio>
#include <sstream>

namespace volume {

std::vector<std::string> words(const std::string &line) {
    std::istringstream input(line.substr(0, line.find('#')));
    std::vector<std::string> found;
    for (std::string word; input >> word;)
        found.push_back(word);
    return found;
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

double round_step(double range, int parts) {
    const double rough = range / parts;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    const double lead = rough / power;
    return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

} // namespace volume
