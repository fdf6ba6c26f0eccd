// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lmp_runner.h
/// Runs lmp as another process in a temporary folder and reads what it printed.
#ifndef LSM_PHYSICS_LMP_RUNNER_H
#define LSM_PHYSICS_LMP_RUNNER_H

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// Defined by CMake: LSM_LMP, LSM_INPUTS, LSM_MPIEXEC, LSM_MPIEXEC_NP.

namespace physics {

using Variables = std::vector<std::pair<std::string, std::string>>;

inline std::string read_file(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// A number with 17 significant digits, so that reading it from a script gives the same double.
inline std::string text(double value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

/// A script with other words at one place, where `from` is.
inline std::string replaced(std::string script, const std::string &from, const std::string &to) {
  const std::size_t at = script.find(from);
  if (at == std::string::npos) throw std::runtime_error("'" + from + "' is not in the script");
  return script.replace(at, from.size(), to);
}
/// The same for all from `from` up to the next `until`.
inline std::string replaced(const std::string &script, const std::string &from,
                            const std::string &until, const std::string &to) {
  const std::size_t at = script.find(from), end = script.find(until, at);
  if (end == std::string::npos)
    throw std::runtime_error("'" + from + "' to '" + until + "' is not in the script");
  return replaced(script, script.substr(at, end - at), to);
}

/// Results of a run.
struct Result {
  int exit_code = -1;                                 ///< 128 + signal if killed
  std::string output;                                 ///< standard output and error
  std::vector<std::map<std::string, double>> thermo;  ///< rows of all runs by column name
  std::map<std::string, double> printed;              ///< lines "name = number" of print commands

  /// Last thermo value of a column; fails the test and returns NaN if there is none.
  double last(const std::string &column) const {
    if (!thermo.empty()) {
      const auto found = thermo.back().find(column);
      if (found != thermo.back().end()) return found->second;
    }
    ADD_FAILURE() << "no thermo column " << column << " in:\n" << output;
    return std::numeric_limits<double>::quiet_NaN();
  }
  /// Value of a print line; fails the test and returns NaN if there is none.
  double value(const std::string &name) const {
    const auto found = printed.find(name);
    if (found != printed.end()) return found->second;
    ADD_FAILURE() << "no line '" << name << " = ' in:\n" << output;
    return std::numeric_limits<double>::quiet_NaN();
  }
  /// The last rows only.
  Result tail(std::size_t rows) const {
    Result out = *this;
    out.thermo.erase(out.thermo.begin(), out.thermo.end() - static_cast<std::ptrdiff_t>(rows));
    return out;
  }
  /// Lines of the output that contain the given text.
  std::vector<std::string> lines_with(const std::string &part) const {
    std::vector<std::string> found;
    std::istringstream in(output);
    for (std::string line; std::getline(in, line);)
      if (line.find(part) != std::string::npos) found.push_back(line);
    return found;
  }
};

inline void parse_output(Result &result) {
  std::istringstream in(result.output);
  std::vector<std::string> columns;
  for (std::string line; std::getline(in, line);) {
    std::istringstream split(line);
    const std::vector<std::string> words{std::istream_iterator<std::string>(split), {}};
    if (words.empty()) continue;
    if (words[0] == "Step") {
      columns = words;
      continue;
    }
    if (words[0] == "Loop") columns.clear();
    char *end = nullptr;
    if (!columns.empty() && words.size() == columns.size()) {
      std::map<std::string, double> row;
      for (std::size_t n = 0; n < words.size(); ++n) {
        row[columns[n]] = std::strtod(words[n].c_str(), &end);
        if (*end != '\0') break;
      }
      if (row.size() == words.size() && *end == '\0') result.thermo.push_back(row);
    } else if (words.size() == 3 && words[1] == "=") {
      const double value = std::strtod(words[2].c_str(), &end);
      if (*end == '\0') result.printed[words[0]] = value;
    }
  }
}

/// Test fixture with a folder of its own, which all tests of a suite share.
class Lmp : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::string name = (std::filesystem::temp_directory_path() / "lsm-physics-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot create a temporary folder");
    folder() = name;
  }
  static void TearDownTestSuite() {
    std::error_code code;
    std::filesystem::remove_all(folder(), code);
  }
  static std::string path(const std::string &name) { return (folder() / name).string(); }

  /// Runs a scene of the inputs folder.
  static Result run_scene(const std::string &name, const Variables &variables = {}, int ranks = 1) {
    return start(std::string(LSM_INPUTS) + "/" + name, variables, ranks);
  }
  /// Runs a script given as text.
  static Result run_text(const std::string &script, const Variables &variables = {},
                         int ranks = 1) {
    std::ofstream(path("script.in")) << script;
    return start("script.in", variables, ranks);
  }
  /// The same for runs that are to succeed: otherwise the test fails and ends.
  static Result ran_scene(const std::string &name, const Variables &variables = {}, int ranks = 1) {
    return good(run_scene(name, variables, ranks));
  }
  static Result ran(const std::string &script, const Variables &variables = {}, int ranks = 1) {
    return good(run_text(script, variables, ranks));
  }
  /// Calls act(newton, ranks) for runs that are to be as that of one rank with newton off.
  template <class Act>
  static void each_split(const Act &act) {
    for (const auto &[newton, ranks] : {std::pair("on", 1), {"off", 2}, {"on", 4}}) {
      SCOPED_TRACE("newton " + std::string(newton) + ", ranks " + std::to_string(ranks));
      act(Variables{{"newton", newton}}, ranks);
    }
  }
  /// Expects one line of error with all the given parts.
  static void refused(const std::vector<std::string> &parts, const std::string &script,
                      const Variables &variables = {}, int ranks = 1);

 private:
  static Result good(Result result) {
    if (result.exit_code == 0) return result;
    throw std::runtime_error("exit code " + std::to_string(result.exit_code) + "\n" +
                             result.output);
  }
  static std::filesystem::path &folder() {
    static std::filesystem::path one;
    return one;
  }

  static Result start(const std::string &script, const Variables &variables, int ranks) {
    std::vector<std::string> words;
    if (ranks > 1) words = {LSM_MPIEXEC, "--oversubscribe", LSM_MPIEXEC_NP, std::to_string(ranks)};
    // The same tests can be run with another program.
    const char *other = std::getenv("LSM_LMP");
    for (const char *word : {other ? other : LSM_LMP, "-in", script.c_str(), "-log", "none"})
      words.emplace_back(word);
    for (const auto &variable : variables)
      words.insert(words.end(), {"-var", variable.first, variable.second});
    std::vector<char *> argv;
    for (auto &word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    const std::string out = path("output.txt"), where = folder().string();
    const pid_t child = fork();
    if (child == 0) {
      const int from = open("/dev/null", O_RDONLY);
      const int to = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
      dup2(from, 0);
      dup2(to, 1);
      dup2(to, 2);
      if (chdir(where.c_str()) == 0) execv(argv[0], argv.data());
      _exit(127);
    }
    int status = -1;
    waitpid(child, &status, 0);
    Result result;
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.output = read_file(out);
    parse_output(result);
    return result;
  }
};

/// Whether the run failed with exactly one error line, which contains all the given parts.
inline ::testing::AssertionResult failed_with(const Result &result,
                                              const std::vector<std::string> &parts) {
  if (result.exit_code == 0)
    return ::testing::AssertionFailure() << "the run succeeded:\n" << result.output;
  auto lines = result.lines_with("ERROR");
  // Open MPI sometimes adds lines of its own when one rank aborts.
  lines.erase(std::remove_if(lines.begin(), lines.end(),
                             [](const std::string &line) {
                               return line.find("ORTE_ERROR_LOG") != std::string::npos ||
                                      line.find("PMIX ERROR") != std::string::npos;
                             }),
              lines.end());
  if (lines.size() != 1)
    return ::testing::AssertionFailure() << lines.size() << " lines of error:\n" << result.output;
  for (const auto &part : parts)
    if (lines[0].find(part) == std::string::npos)
      return ::testing::AssertionFailure() << "'" << part << "' is not in: " << lines[0];
  return ::testing::AssertionSuccess();
}

inline void Lmp::refused(const std::vector<std::string> &parts, const std::string &script,
                         const Variables &variables, int ranks) {
  EXPECT_TRUE(failed_with(run_text(script, variables, ranks), parts))
      << script.substr(script.size() - std::min<std::size_t>(script.size(), 400));
}

/// Largest difference between two thermo tables, relative to the largest value of each column. The
/// test fails if a column is zero throughout in both, as it would prove nothing.
inline double thermo_difference(const Result &a, const Result &b,
                                const std::vector<std::string> &columns) {
  EXPECT_EQ(a.thermo.size(), b.thermo.size());
  double worst = 0.0;
  for (const auto &column : columns) {
    double scale = 0.0, off = 0.0;
    for (std::size_t n = 0; n < std::min(a.thermo.size(), b.thermo.size()); ++n) {
      const double x = a.thermo[n].at(column), y = b.thermo[n].at(column);
      scale = std::max({scale, std::fabs(x), std::fabs(y)});
      off = std::max(off, std::fabs(x - y));
      if (!std::isfinite(x) || !std::isfinite(y)) return std::numeric_limits<double>::infinity();
    }
    EXPECT_GT(scale, 0.0) << "column " << column << " is zero throughout";
    if (scale > 0.0) worst = std::max(worst, off / scale);
  }
  return worst;
}

/// Expects the same last values, but for a relative error.
inline void expect_near(const Result &a, const Result &b, const std::vector<std::string> &columns,
                        double tolerance) {
  for (const std::string &column : columns)
    EXPECT_NEAR(a.last(column), b.last(column), tolerance * std::fabs(b.last(column))) << column;
}

}  // namespace physics

#endif
