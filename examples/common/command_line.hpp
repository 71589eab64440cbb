// What the command lines of the programs on streams share, by CLI11.
#pragma once

#include "common/file_options.hpp"

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace demo {

// Adds --csv, --json, which exclude each other, and the rest to `app`; values go to `options`.
void add_file_options(CLI::App &app, FileOptions &options, const char *group);

// Parses the command line. False: `status` is what the program ends with at once (after --help, or an error that was
// printed).
bool parse(CLI::App &app, int argc, char **argv, int &status);

template <typename Value>
using Choices = std::vector<std::pair<std::string, Value>>;

// An option that takes one of some words; the first one is the default.
template <typename Value>
void add_choice(CLI::App &app, const char *name, Value &value, const Choices<Value> &choices, const char *text,
                const char *group) {
    std::vector<std::string> words;
    for (const auto &[word, number] : choices)
        words.push_back(word);
    const auto choose = [&value, choices](const std::string &chosen) {
        for (const auto &[word, number] : choices)
            if (word == chosen)
                value = number;
    };
    app.add_option_function<std::string>(name, choose, text)
        ->check(CLI::IsMember(words))
        ->type_name("")
        ->default_str(words.front())
        ->group(group);
}

} // namespace demo
