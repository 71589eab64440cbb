// The parameters of a request, checked.
#pragma once

#include "explorer/http.hpp"

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace explorer {

// Every read names a parameter and its range; what is wrong throws a Failure of status 400 that names parameter and
// value.
class Arguments {
public:
    explicit Arguments(const Request &request); // throws where a parameter is given twice

    bool has(const std::string &name) const { return params_.count(name) != 0; }
    std::string text(const std::string &name, const std::string &otherwise);
    std::optional<double> number(const std::string &name, double least, double most);
    std::optional<int64_t> integer(const std::string &name, int64_t least, int64_t most);
    double needed_number(const std::string &name, double least, double most);
    int64_t needed_integer(const std::string &name, int64_t least, int64_t most);

    // One of some words: its index; the first one where it is not given.
    size_t word(const std::string &name, const std::vector<std::string> &words);

    // Numbers between commas.
    std::vector<double> numbers(const std::string &name, const std::string &text);

    // Throws if a parameter is left that nobody has asked for.
    void done() const;

private:
    const std::string *find(const std::string &name);

    const std::multimap<std::string, std::string> &params_;
    std::set<std::string> known_;
};

// The text as it may stand in an error: cut, without control characters.
std::string shown(const std::string &text);

} // namespace explorer
