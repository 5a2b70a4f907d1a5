// SPDX-License-Identifier: BSD-3-Clause
// warren example: writes a world of examples/worlds, which the program has in it, where one stands, and says the
// command that shows it. What there is to see stands in the table of the folder's README.md alone.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/base/printable.hpp"
#include "scenes/text/input_file_io.hpp"
#include "scenes/text/output_file_io.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/verbs/example_files.hpp"
#include "tools/words/option_values.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec example_specs[] = {{"--output", "FOLDER", "where to (default: where you are)", {}, "-o"}};

std::string_view bytes_of(std::string_view name) {
  if (name == "puma-seed.scene") name = "puma.scene";
  return std::ranges::find(example_files(), name, &EmbeddedFile::name)->bytes;
}

std::vector<std::string_view> quoted(std::string_view text) {
  const std::vector<std::string_view> pieces = split(text, "`");
  std::vector<std::string_view> inside;
  for (std::size_t i = 1; i < pieces.size(); i += 2) inside.push_back(pieces[i]);
  return inside;
}

/// Is the file there as it shall be? Throws UsageError where another stands in its place.
bool is_there(const std::string& file, std::string_view bytes) {
  check_writable(file);
  if (!std::filesystem::exists(file)) return false;
  if (std::filesystem::is_regular_file(file) && InputFile(file, {}).bytes() == bytes) return true;
  throw UsageError(fmt::format("{}: is there already, and is another file; -o FOLDER writes elsewhere", file));
}

int example(const Arguments& arguments) {
  if (arguments.operand_count() == 0) {
    for (const Example& each : examples()) print_text(fmt::format("{:<12} {}\n", each.name, each.sight));
    print_text("'warren example NAME' writes one of them where you are.\n");
    return exit_code::success;
  }
  const Example chosen = example_named(arguments.operand(0));
  const std::string folder = arguments.value("--output").value_or("");
  write_example_files(chosen, folder);
  print_text(fmt::format("{}: {}\ntry{}: {}\n", fmt::join(chosen.files, ", "), chosen.sight,
                         folder.empty() ? "" : " in " + folder, chosen.command));
  return exit_code::success;
}

}  // namespace

std::vector<Example> examples() {
  std::vector<Example> all;
  for (const std::string_view row : split(bytes_of("README.md"), "\n")) {
    if (!row.starts_with("| `")) continue;
    const std::size_t bar = row.find(" | ");
    const std::string_view says = row.substr(bar + 3);
    const auto files = quoted(row.substr(0, bar));
    all.push_back({files[0].substr(0, files[0].find('.')), files, says.substr(0, says.find(": `")), quoted(says)[0]});
  }
  return all;
}

Example example_named(std::string_view name) {
  if (name == "puma-seed") {  // `puma` by its name of before, which scripts may know
    return {"puma-seed",
            {"puma-seed.scene"},
            "a Puma 560 among spheres; its name is puma now",
            "warren solve puma-seed.scene --optimise --picture puma.svg"};
  }
  const std::vector<Example> all = examples();
  std::vector<std::string_view> names;
  for (const Example& each : all) names.push_back(each.name);
  return all[choice_value("NAME", name, names)];
}

std::string write_example_files(const Example& example, const std::string& folder) {
  const auto place = [&](std::string_view name) {
    return folder.empty() ? std::string{name} : fmt::format("{}/{}", folder, name);
  };
  std::vector<std::string_view> missing;
  for (const std::string_view name : example.files) {
    if (!is_there(place(name), bytes_of(name))) missing.push_back(name);
  }
  for (const std::string_view name : missing) write_file(place(name), bytes_of(name), {});
  return place(example.files.front());
}

Command example_command() {
  return {"example", "[NAME]", "write a world to try things on, or list them", joined_options({example_specs}),
          example};
}

}  // namespace warren::tools
