// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/output_files.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <system_error>

#include "apps/studies/contest_pictures.hpp"
#include "core/base/printable.hpp"
#include "pictures/formats/write_picture.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/kept/export_roadmap.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/words/option_values.hpp"

namespace warren::tools {
namespace {

[[noreturn]] void fail(const std::string& path, int error) {
  throw WriteError(path, std::generic_category().message(error));
}

/// "-runs-solved" of "runs solved"
std::string file_words(std::string_view title) { return '-' + studies::file_name(title, '-'); }

/// "k-length.pdf" of "k.pdf" and "maze:5x7: length"; where several titles end so, of whole titles, then with a number.
std::vector<std::string> figure_files(const std::string& file, const std::vector<PlotSheet>& sheets) {
  const std::string ending = ending_of(file);
  std::map<std::string, std::size_t> count;
  const auto end_of = [](const std::string& title) { return file_words(title.substr(title.rfind(": ") + 1)); };
  for (const PlotSheet& sheet : sheets) ++count[end_of(sheet.title())];
  std::set<std::string> names;
  std::vector<std::string> files;
  for (const PlotSheet& sheet : sheets) {
    const bool is_alone = count[end_of(sheet.title())] == 1;
    const std::string words = is_alone ? end_of(sheet.title()) : file_words(sheet.title());
    std::string name = words;
    for (std::size_t n = 2; !names.insert(name).second; ++n) name = fmt::format("{}-{}", words, n);
    files.push_back(file.substr(0, file.size() - ending.size()) + name + ending);
  }
  return files;
}

/// "a" of "a/b.svg"; "." of "b.svg".
std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder;
}

/// Throws UsageError where the file's ending is none of `endings`, such as ".svg .png". Standard output and devices
/// have none, and "" is no file.
void check_picture_ending(std::string_view option, const std::string& file, std::string_view endings) {
  const std::string ending = ending_of(file);
  if (ending.empty() && (file.empty() || is_written_straight(file))) return;
  if (is_among(ending, endings)) return;
  throw UsageError(fmt::format("{}: a picture here ends in one of: {} (found: '{}')", option, endings, file));
}

/// Of all verbs: the options whose values are files that are written, and that are read. Operands are read.
constexpr std::array<std::string_view, 16> output_options{
    "--path",  "--json",   "--picture", "--table",  "--html",         "--csv",    "--runs",   "--log",
    "--trace", "--output", "--keep",    "--report", "--save-roadmap", "--resume", "--curves", "--certificate"};
constexpr std::array<std::string_view, 6> input_options{"--answer", "--map",   "--batch",
                                                        "--matrix", "--world", "--srdf"};

/// What `solve` writes there `verify` reads.
bool reads_certificate(const Arguments& arguments) { return arguments.verb() == "verify"; }

/// Where a file is, or will be: two are the same file exactly if their places are equal.
struct Place {
  dev_t device = 0;
  ino_t inode = 0;   ///< the file's, or while there is none its folder's
  std::string name;  ///< empty where the file exists
  bool operator==(const Place&) const = default;
};

struct NamedFile {
  std::string option;  ///< what named it, for people
  std::string path;
};

std::string name_in_folder(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// Of "-" the file that standard input or output is redirected to; a pipe or terminal may well be both.
std::optional<Place> place_of(const std::string& path, int standard) {
  struct stat status {};
  if (path == "-") {
    if (::fstat(standard, &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    return Place{status.st_dev, status.st_ino, {}};
  }
  if (::stat(path.c_str(), &status) == 0) {
    // Nothing is lost on a device; folders are refused elsewhere.
    if (S_ISCHR(status.st_mode) || S_ISDIR(status.st_mode)) return std::nullopt;
    return Place{status.st_dev, status.st_ino, {}};
  }
  const std::string real = behind_links(path);
  if (::stat(folder_of(real).c_str(), &status) != 0) return std::nullopt;
  return Place{status.st_dev, status.st_ino, name_in_folder(real)};
}

std::vector<NamedFile> outputs_of(const Arguments& arguments) {
  std::vector<NamedFile> files;
  for (const std::string_view option : output_options) {
    const auto path = arguments.value(option);
    if (!path || path->empty()) continue;  // as a flag, --csv names no file
    if (option == "--certificate" && reads_certificate(arguments)) continue;
    files.push_back({std::string{option}, is_standard_output(*path) ? "-" : *path});
    if (option != "--output") continue;
    const std::string ending = ending_of(*path);
    if (ending == ".yaml") files.push_back({"its image", map_image_of(*path)});
    if (ending == ".gr" || ending == ".csv") files.push_back({"its second file", files_of_export(*path).back()});
  }
  const char* const many = arguments.has("--batch") ? "--batch" : "--matrix";  // both are refused by name
  if (arguments.has(many)) files.push_back({fmt::format("the answers to {}", many), "-"});
  return files;
}

void check_standard_stream(const std::vector<NamedFile>& files, std::string_view refusal) {
  const NamedFile* taker = nullptr;
  for (const NamedFile& file : files) {
    if (file.path != "-") continue;
    if (taker != nullptr) throw UsageError(fmt::format(fmt::runtime(refusal), taker->option, file.option));
    taker = &file;
  }
}

/// Is that the name of a picture that `compare --pictures` may write? They begin with the planner's.
bool is_picture_name(const Arguments& arguments, std::string_view name) {
  if (!name.ends_with(".svg")) return false;
  if (name == "paths.svg") return true;
  return std::ranges::any_of(given_list(arguments, "--planners"), [&](const std::string& planner) {
    return name.starts_with(planner + '.') || name.starts_with(planner + '_');
  });
}

/// No picture that `option` writes into `folder` may take the place of any of these files.
void check_many(std::string_view option, const std::string& folder, const std::vector<NamedFile>& files,
                const std::function<bool(std::string_view)>& may_be_written) {
  for (const NamedFile& file : files) {
    const std::string real = behind_links(file.path);
    std::error_code missing;
    const bool beside = std::filesystem::equivalent(folder_of(real), folder, missing);
    if (beside && may_be_written(name_in_folder(real))) {
      throw UsageError(fmt::format("{}: {} may be the name of one of the pictures", option, file.path));
    }
  }
}

}  // namespace

void check_writable(const std::string& path) {
  if (path == "-") return;
  if (path.empty()) fail("''", ENOENT);
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) fail(path, EISDIR);
    if (::access(path.c_str(), W_OK) != 0) fail(path, errno);
    if (!S_ISREG(status.st_mode)) return;  // devices and pipes are written straight
  } else if (errno != ENOENT) {
    fail(path, errno);
  }
  if (::access(folder_of(behind_links(path)).c_str(), W_OK | X_OK) != 0) fail(path, errno);
}

void check_picture(std::string_view option, const std::string& file) {
  check_picture_ending(option, file, picture_endings);
  if (ending_of(file) == ".pdf" && !can_write_pdf()) {
    throw UsageError(fmt::format("{}: this warren was built without libharu and writes no .pdf; say .svg", option));
  }
}

void say_of_picture(const Arguments& arguments, const std::string& file, const std::vector<std::string>& notes) {
  if (notes.empty() || arguments.has("--quiet")) return;
  say_on_standard_error(fmt::format("warren: note: {}: drawn {}\n", printable(file), fmt::join(notes, "; ")));
}

std::optional<std::string> output_file(const Arguments& arguments, std::string_view option) {
  std::optional<std::string> file = arguments.value(option);
  if (file) check_writable(*file);
  return file;
}

void check_reports(const Arguments& arguments, std::initializer_list<std::string_view> options) {
  for (const std::string_view option : options) output_file(arguments, option);
}

void write_report(const Arguments& arguments, std::string_view option, const std::function<std::string()>& text) {
  if (const auto file = arguments.value(option)) write_file(*file, text(), Execution{});
}

void check_plots(const Arguments& arguments) {
  if (arguments.has("--figures") && ending_of(*arguments.value("--figures")).empty()) {
    throw UsageError("--figures: expected a name that ends in .svg, .png or .pdf, such as k.pdf for k-length.pdf");
  }
  for (const std::string_view option : {"--picture", "--figures"}) {
    const std::string file = arguments.value(option).value_or("");
    check_picture_ending(option, file, plot_endings);
    check_picture(option, file);
  }
  const std::string curves = arguments.value("--curves").value_or("");
  check_picture_ending("--curves", curves, fmt::format("{} .csv", plot_endings));
  check_picture("--curves", curves.ends_with(".csv") ? "" : curves);
}

void write_plots(const Arguments& arguments, const Execution& execution, bool was_stopped,
                 const std::function<PlotsPage()>& plots, std::string_view option) {
  const auto file = arguments.value(option);
  const auto figures = option == "--picture" ? arguments.value("--figures") : std::nullopt;
  if (!file && !figures) return;
  const Deadline memory_alone(std::numeric_limits<double>::infinity(), execution.deadline->memory_bytes());
  Execution within = execution;
  if (was_stopped) within.deadline = &memory_alone;
  const PlotsPage page = plots();
  if (file) page.write(*file, arguments.command_line(), within);
  if (!figures) return;
  const std::vector<std::string> files = figure_files(*figures, page.sheets);
  for (std::size_t i = 0; i < files.size(); ++i) {
    PlotsPage{{page.sheets[i]}}.write(files[i], arguments.command_line(), within);
  }
}

void check_outputs(const Arguments& arguments) {
  std::vector<NamedFile> files = outputs_of(arguments);
  check_standard_stream(files, "standard output takes one of them: {} or {}");
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto place = place_of(files[i].path, STDOUT_FILENO);
    for (std::size_t j = 0; place && j < i; ++j) {
      if (place_of(files[j].path, STDOUT_FILENO) == place) {
        throw UsageError(fmt::format("{} and {} would both write {}", files[j].option, files[i].option, files[i].path));
      }
    }
  }
  std::vector<NamedFile> inputs;
  for (std::size_t i = 0; i < arguments.operand_count(); ++i) inputs.push_back({"an operand", arguments.operand(i)});
  for (const std::string_view option : input_options) {
    for (std::string& path : arguments.values(option)) inputs.push_back({std::string{option}, std::move(path)});
  }
  const auto proof = arguments.value("--certificate");
  if (proof && reads_certificate(arguments)) inputs.push_back({"--certificate", *proof});
  check_standard_stream(inputs, "{} and {} can't both come from standard input");
  for (const NamedFile& input : inputs) check_not_written(arguments, input.path);
  files.insert(files.end(), inputs.begin(), inputs.end());
  if (const auto folder = arguments.value("--pictures")) {
    check_many("--pictures", *folder, files, [&](std::string_view name) { return is_picture_name(arguments, name); });
  }
  if (const auto file = arguments.value("--figures")) {
    const std::string ending = ending_of(*file);
    const std::string own = name_in_folder(*file);
    const std::string begin = own.substr(0, own.size() - ending.size()) + "-";
    check_many("--figures", folder_of(*file), files,
               [&](std::string_view name) { return name.ends_with(ending) && name.starts_with(begin); });
  }
}

bool takes_standard_output(const Arguments& arguments) {
  return std::ranges::count(outputs_of(arguments), std::string_view("-"), &NamedFile::path) > 0;
}

void check_not_written(const Arguments& arguments, const std::string& input) {
  const bool is_file = !input.empty() && !is_made_source(input);
  const auto place = is_file ? place_of(input, STDIN_FILENO) : std::nullopt;
  if (!place || !place->name.empty()) return;  // what is not there can't be overwritten
  for (const NamedFile& output : outputs_of(arguments)) {
    if (place_of(output.path, STDOUT_FILENO) == place) {
      throw UsageError(fmt::format("{}: {} would overwrite {}, which is read", output.option, output.path, input));
    }
  }
}

void check_not_written(const Arguments& arguments, const std::optional<RobotSpec>& robot, const Prices& prices) {
  if (robot) check_not_written(arguments, robot->table);
  const ArmFiles files = robot ? robot->files.value_or(ArmFiles{}) : ArmFiles{};
  for (const std::string& file : {files.urdf, files.srdf}) check_not_written(arguments, file);
  for (const PriceMask& mask : prices.masks) {
    check_not_written(arguments, mask.file);
    if (mask.read) check_not_written(arguments, mask.read->image);
  }
}

}  // namespace warren::tools
