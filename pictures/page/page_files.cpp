// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/page/page_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "pictures/model/xml_text.hpp"

namespace warren {

std::string_view page_file(std::string_view name) {
  const auto files = page_files();
  return std::find_if(files.begin(), files.end(), [&](const EmbeddedFile& file) { return file.name == name; })->bytes;
}

std::string head_of_page(const std::string& title, std::string_view style) {
  return fmt::format(R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:">
<link rel="icon" href="data:,">
<title>{}</title>
<style>
{}</style>
</head>
)",
                     xml_text(title), style);
}

}  // namespace warren
