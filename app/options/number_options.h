#pragma once

#include <CLI/CLI.hpp>

namespace app {

/// Gives every option with a value, of an app and its subcommands at any depth, a check that
/// comes before its own ones: text is not empty; a number is written in decimal, finite, without
/// a sign where none can be, and fits its type. (By itself CLI11 takes `nan`, reads 010 as eight
/// and -1 as 2^64 - 1, and takes an empty text for an option that was left out.)
void CheckValues(CLI::App& app);

}  // namespace app
