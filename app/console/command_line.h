#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace app {

/// The arguments of a command line, the program's name left out, with `help A B` as `A B --help`
/// and `help` as `--help`.
/// @throws InputError for an argument, or a current folder, that is not UTF-8: the files that
///   are written name paths, and could not be read again
std::vector<std::string> ArgumentsOf(int argc, const char* const* argv);

/// Tells of a word that stands where a subcommand is expected and is none, and of the one that
/// was perhaps meant; of an option there that is none, too.
/// @throws InputError
void RequireKnownCommands(const CLI::App& app, const std::vector<std::string>& arguments);

/// The command that was parsed, as it is called: "pas scene make".
std::string CommandName(const CLI::App& app);

}  // namespace app
