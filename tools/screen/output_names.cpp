// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/output_names.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <limits>
#include <map>
#include <set>
#include <system_error>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"
#include "parallel/deadline.hpp"
#include "pictures/formats/write_picture.hpp"
#include "scenes/text/output_file_io.hpp"
#include "tools/screen/last_words.hpp"

namespace warren::tools {
namespace {

[[noreturn]] void fail(const std::string& path, int error) {
  throw WriteError(path, std::generic_category().message(error));
}

/// "-runs-solved" of "runs solved"
std::string file_words(std::string_view title) {
  std::string words;
  for (const char c : title) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (is_plain || !(words.empty() || words.ends_with('-'))) words += is_plain ? c : '-';
  }
  return '-' + words.substr(0, words.find_last_not_of('-') + 1);
}

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

}  // namespace

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

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

void check_picture_ending(std::string_view option, const std::string& file, std::string_view endings) {
  const std::string ending = ending_of(file);
  if (ending.empty() || fmt::format(" {} ", endings).find(" " + ending + " ") != std::string::npos) return;
  throw UsageError(fmt::format("{}: a picture here ends in one of: {} (found: '{}')", option, endings, file));
}

std::optional<std::string> output_file(const Arguments& arguments, std::string_view option) {
  std::optional<std::string> file = arguments.value(option);
  if (file) check_writable(*file);
  return file;
}

bool check_reports(const Arguments& arguments, std::initializer_list<std::string_view> options) {
  bool taken = false;
  for (const std::string_view option : options) taken = output_file(arguments, option) == "-" || taken;
  return taken;
}

void write_report(const Arguments& arguments, std::string_view option, const std::function<std::string()>& text) {
  if (const auto file = arguments.value(option)) write_file(*file, text(), Execution{});
}

void check_plots(const Arguments& arguments) {
  for (const std::string_view option : {"--picture", "--figures"}) {
    const std::string file = arguments.value(option).value_or("");
    check_picture_ending(option, file, plot_endings);
    check_picture(option, file);
  }
  if (arguments.has("--figures") && ending_of(*arguments.value("--figures")).empty()) {
    throw UsageError("--figures: expected a name that ends in .svg, .png or .pdf, such as k.pdf for k-length.pdf");
  }
}

void write_plots(const Arguments& arguments, const Execution& execution, bool was_stopped,
                 const std::function<PlotsPage()>& plots) {
  const auto file = arguments.value("--picture");
  const auto figures = arguments.value("--figures");
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

}  // namespace warren::tools
