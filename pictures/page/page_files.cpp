// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/page/page_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "pictures/formats/markup.hpp"

namespace warren {
namespace {

const EmbeddedFile& file_named(std::string_view name) {
  const auto files = page_files();
  return *std::find_if(files.begin(), files.end(), [&](const EmbeddedFile& file) { return file.name == name; });
}

/// "'sha256-…'": what a policy names a script by.
std::string source_of(std::string_view script) {
  const std::string_view hex = file_named(script).sha256;
  std::string bytes;
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes += static_cast<char>(16 * digit(hex[i]) + digit(hex[i + 1]));
  }
  std::string text = "'sha256-";
  const Write append = [&](std::string_view piece) { text += piece; };
  Base64 base64(append);
  base64.write(bytes);
  base64.end();
  return text + "'";
}

}  // namespace

std::string_view page_file(std::string_view name) { return file_named(name).bytes; }

std::string script_element(std::string_view name) { return fmt::format("<script>{}</script>\n", page_file(name)); }

std::string head_of_page(const std::string& title, std::string_view style, std::span<const std::string_view> scripts) {
  std::string sources;
  for (const std::string_view script : scripts) sources += " " + source_of(script);
  return fmt::format(R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src{}; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'">
<link rel="icon" href="data:,">
<title>{}</title>
<style>
{}</style>
</head>
)",
                     sources, xml_text(title), style);
}

}  // namespace warren
