// SPDX-License-Identifier: GPL-2.0-or-later
#include "plot.h"

#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

#include <fmt/core.h>

#include "new_file.h"
#include "files/output_file.h"
#include "files/text.h"

namespace LSM::postproc {

namespace fs = std::filesystem;

namespace {

// The line types have Okabe and Ito's colours, which are safe for any kind of colour vision, each
// with its own point type and dashes, so that curves differ in black and white as well. From the
// seventh on, where colours are too many to be told apart or occur again, points are letters.
constexpr std::string_view prelude = R"(
set datafile separator comma
set encoding utf8
set linetype 1 lc rgb "#0072B2" pt 7  dt 1 lw 1.6 ps 0.8*point
set linetype 2 lc rgb "#D55E00" pt 5  dt (14,6) lw 1.6 ps 0.75*point
set linetype 3 lc rgb "#009E73" pt 9  dt (4,4) lw 1.8 ps 0.95*point
set linetype 4 lc rgb "#CC79A7" pt 13 dt (14,4,3,4) lw 1.6 ps 1.0*point
set linetype 5 lc rgb "#E69F00" pt 4  dt (20,4,3,4,3,4) lw 1.6 ps 0.8*point
set linetype 6 lc rgb "#56B4E9" pt 6  dt (8,3) lw 1.6 ps 0.85*point
colours = "#0072B2 #D55E00 #009E73 #CC79A7 #E69F00 #56B4E9 #7A6A00 #000000"
letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
do for [n = 7:58] {
set linetype n lc rgb word(colours, 1 + (n - 1) % 8) pt letters[n-6:n-6] dt (3,5) lw 1.4 ps 1.1*point
}
set linetype 8 dt 1
set linetype cycle 58
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid xtics ytics lt 1 dt 1 lw 0.5 lc rgb "#d8d8d8"
set key outside bottom center horizontal samplen 3 spacing 1.15 maxcols 2 width -3 Left reverse height 1
)";

/// Extracts the reason of a failure from gnuplot's messages. It is in the last line, except that a
/// missing file is named only in a warning.
std::string gnuplot_message(const std::string &text) {
  std::string warning, last;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::string trimmed(text::trim(line));
    // In a locale that is not UTF-8, gnuplot prints the harmless "iconv failed" for every picture.
    if (trimmed.empty() || trimmed.find("iconv failed") != std::string::npos) continue;
    if (warning.empty() && trimmed.find("warning: ") != std::string::npos)
      warning = trimmed.substr(trimmed.find("warning: ") + 9) + "; ";
    last = trimmed;
  }
  return warning + last;
}

/// Quotes a word of a shell command.
std::string shell_word(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

/// Runs a script of gnuplot in its folder.
/// \throws PlotError with gnuplot's own message
void run_gnuplot(const fs::path &folder, const std::string &script) {
  // -d keeps the start-up file of the user from changing the pictures.
  const std::string command = "{ cd " + shell_word((fs::path(".") / folder).string()) +
                              " && exec gnuplot -d " + shell_word(script) +
                              "; } 2>&1 >/dev/null </dev/null";
  std::FILE *const pipe = popen(command.c_str(), "re");
  if (!pipe) throw PlotError("cannot start gnuplot: " + std::generic_category().message(errno));
  std::string messages;
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    messages.append(buffer.data(), count);
  const int status = pclose(pipe);
  if (status == 0) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
    throw PlotError("gnuplot not found (Debian package gnuplot-nox)");
  throw PlotError("gnuplot failed: " + gnuplot_message(messages));
}

std::string script_head(const std::string &name) {
  return fmt::format(
      "# Draws {0}.png and {0}.svg from\n# {0}.csv: run `gnuplot ./{0}.gp` in this folder.\n",
      name);
}

std::string whole_script(const std::string &name, const Figure &figure) {
  const auto &[table, body, size] = figure;
  std::string script =
      script_head(name) +
      fmt::format(
          "base = {}\ntable = base.\".csv\"\nif (!exists(\"formats\")) formats = \"png svg\"\n",
          quote_plain("./" + name));
  script += fmt::format(
      "\ndo for [format in formats] {{\n"
      "if (format eq \"png\") {{\n"
      "point = 1.0\n"
      "set terminal pngcairo size {},{} enhanced font \"DejaVu Sans,26\" linewidth 2 pointscale 2 "
      "background \"#ffffff\"\n"
      "}} else {{\n"
      "point = 0.65\n"
      "set terminal svg size {},{} dynamic enhanced{} font \"DejaVu Sans,13\" background "
      "\"#ffffff\"\n"
      "}}\n"
      "{}"
      "set output base.\".\".format\n",
      2 * size.width, 2 * size.height, size.width, size.height,
      // Without `standalone`, gnuplot writes images to files of their own.
      body.find("with image") != std::string::npos ? " standalone" : "", prelude);
  return script + body + "unset output\n}\n";
}

void check_name(const fs::path &base) {
  const std::string name = base.filename().string();
  if (name.empty() || name == "." || name == "..")
    throw FileError("--output '" + base.string() + "' ends with a folder, expected a file name");
  for (const char c : name)
    if (static_cast<unsigned char>(c) < 0x20)
      throw FileError("--output has a line break or another control character in it");
}

std::string file_text(const fs::path &path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Whether a picture is complete: gnuplot does not notice that a disk is full.
bool is_whole(const std::string &picture) {
  const std::string text = file_text(picture);
  return text.find("</svg>") != std::string::npos ||
         text.find("IEND\xae\x42\x60\x82") != std::string::npos;
}

/// Runs BASE.gp. After an error neither picture is left.
/// \throws PlotError unless both pictures were written
/// \throws FileError
void draw(const std::string &base) {
  const fs::path folder = fs::path(base).parent_path(), name = fs::path(base).filename();
  const std::array<std::string, 2> pictures = {base + ".png", base + ".svg"};
  std::error_code code;
  const auto leave_none = [&] {
    for (const std::string &picture : pictures) fs::remove(picture, code);
  };
  leave_none();
  try {
    run_gnuplot(folder, "./" + name.string() + ".gp");
    for (const std::string &picture : pictures)
      if (!is_whole(picture)) {
        constexpr std::uintmax_t little = 1 << 16;
        const bool full = fs::space(fs::path(".") / folder, code).available < little && !code;
        throw PlotError("gnuplot wrote no " + picture + (full ? ": no space left" : ""));
      }
    // gnuplot titles all of its pictures "Gnuplot", which browsers show and screen readers read
    // out.
    std::string svg = file_text(pictures[1]);
    constexpr std::string_view own = "<title>Gnuplot</title>";
    if (const std::size_t at = svg.find(own); at != std::string::npos) {
      svg.replace(at, own.size(), "<title>" + html_escape(name.string()) + "</title>");
      write_file(pictures[1], svg);
    }
  } catch (const PlotError &error) {
    leave_none();
    throw PlotError(base + ".gp: " + error.what() +
                    "; table and script are written (--no-picture: only these)");
  } catch (...) {
    leave_none();
    throw;
  }
}

}  // namespace

void PictureOptions::check(const std::vector<std::string> &inputs,
                           const std::vector<std::string> &more,
                           const std::vector<Output> &others) const {
  check_name(output);
  std::vector<Output> outputs = others;
  for (const char *const text : {".csv", ".gp", ".png", ".svg"})
    outputs.push_back({"--output", output + text});
  for (const std::string &text : more) outputs.push_back({"--output", output + text});
  check_outputs(outputs, inputs);
}

void make(const Figure &figure, const PictureOptions &options) {
  const fs::path base(options.output);
  check_name(base);
  figure.table.write(options.table());
  write_file(options.output + ".gp", whole_script(base.filename().string(), figure));
  if (!options.no_picture) draw(options.output);
  fmt::print("wrote {0}.csv, {0}.gp{1}\n", options.output,
             options.no_picture ? "" : fmt::format(", {0}.png, {0}.svg", options.output));
}

void check_outputs(const Figure &figure, const PictureOptions &options) {
  const std::string base = options.output, script = base + ".gp";
  const Known drawn = begins_with(script_head(fs::path(base).filename().string()));
  check_output(options.table(), options.overwrite,
               [&](std::string_view head) { return figure.table.like(head); });
  check_output(script, options.overwrite, drawn);
  // Pictures cannot be recognized by their content, only by the script beside them.
  const bool ours = files::holds_data(script);
  for (const char *const ending : {".png", ".svg"})
    if (!options.no_picture) check_output(base + ending, options.overwrite || ours);
}

}  // namespace LSM::postproc
