#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The documents say what the programs do.

check-documents.py SOURCE_DIR [PROGRAM...]

Links and anchors of Markdown pages exist; their lines and the comments of scenes and studies are
at most 100 columns wide; READMEs have at most
150 lines; variables.md has every variable of fault.in with its default; the page of each style has
every keyword of its source and no other, with its default; options.md of each program is what its
--help prints (--write as the last word writes it).
"""
import re
import subprocess
import sys
import textwrap
from pathlib import Path

PROBLEMS = []


def problem(text):
    PROBLEMS.append(text)


def outside_code(text):
    """The lines of a Markdown page that are not within ``` fences, with their numbers."""
    inside = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            inside = not inside
        elif not inside:
            yield number, line


def anchor(heading):
    """As GitHub makes them: lower case, punctuation removed, blanks as hyphens."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r" ", "-", re.sub(r"[^\w\- ]", "", heading))


def anchors(page):
    return {anchor(line.lstrip("#")) for _, line in outside_code(page.read_text()) if line.startswith("#")}


def check_markdown(root):
    pages = [root / name for name in subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md"], cwd=root,
                                                    capture_output=True, text=True).stdout.split()]
    pages = pages or [p for p in root.rglob("*.md") if "build" not in p.relative_to(root).parts]
    assert len(pages) > 15, pages
    for page in pages:
        if not page.exists():
            continue
        name, text = page.relative_to(root), page.read_text()
        if page.name == "README.md" and len(text.splitlines()) > 150:
            problem(f"{name}: {len(text.splitlines())} lines, at most 150 expected")
        for number, line in outside_code(text):
            if len(line) > 100 and not line.startswith("|") and "](" not in line:
                problem(f"{name}:{number}: {len(line)} columns, at most 100 expected")
            for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", line)):
                if re.match(r"[a-z]+:", target):
                    continue
                path, _, part = target.partition("#")
                file = page if not path else (page.parent / path)
                if not file.exists():
                    problem(f"{name}:{number}: {target} does not exist")
                elif part and part not in anchors(file):
                    problem(f"{name}:{number}: {target}: no such heading")


def check_comments(root):
    names = subprocess.run(["git", "ls-files", "*.in", "*.ini", "*.gp", "inputs/studies/*.csv", "inputs/*.yaml", "inputs/*.sh"], cwd=root, capture_output=True,
                           text=True).stdout.split()
    for name in names:
        for number, line in enumerate((root / name).read_text().splitlines(), 1):
            if len(line) > 100 and re.match(r" *# \S", line) and "usage" not in line:
                problem(f"{name}:{number}: a comment of {len(line)} columns, at most 100 expected")


def check_scenes(root):
    for scene in sorted((root / "inputs").glob("*.in")) + sorted((root / "tests").rglob("*.in")):
        for number, line in enumerate(scene.read_text().splitlines(), 1):
            itself = re.search(r"\bvariable\s+(\w+)\s+string\s+'[^']*\$\{\1\}", line)
            if itself:
                problem(f"{scene.relative_to(root)}:{number}: variable {itself[1]} from its own value, which LAMMPS 4 Jul 2026 refuses")


def check_variables(root):
    scene = (root / "inputs/fault.in").read_text()
    defaults = {}
    for line in scene.split("units ")[0].splitlines():
        match = re.match(r"variable\s+(\w+)\s+index\s+(\S+)", line)
        if match and match[1] != "quote":
            defaults[match[1]] = match[2].strip("'")
    listed = re.search(r'variable\s+fault string "(.*?)"', scene, re.S)[1].replace("&", "").split()
    listed += re.search(r'variable\s+settings string "(.*?)"', scene, re.S)[1].replace("&", "").split()
    assert len(defaults) > 40 and len(listed) > 40, (defaults, listed)
    table = dict(re.findall(r"^\| `(\w+)` \| (.*?) \|", (root / "inputs/variables.md").read_text(), re.M))
    for name in sorted(set(defaults) | set(listed)):
        if name not in table:
            problem(f"inputs/variables.md: no variable {name} of fault.in")
    for name, said in table.items():
        if name in ("restart", "extra"):  # not defined unless given
            continue
        if name not in defaults and name not in listed:
            problem(f"inputs/variables.md: {name} is no variable of fault.in")
        elif said.startswith("`") and said != f"`{defaults.get(name)}`":
            problem(f"inputs/variables.md: {name} has the default {said}, fault.in {defaults.get(name)}")
        elif not said.startswith("`") and re.fullmatch(r"[\w.+-]+", defaults.get(name, "")):
            problem(f"inputs/variables.md: {name} has the default {said}, fault.in {defaults[name]}")
    others = dict(re.findall(r"^\| `(\w+)` \| `([^`]*)` \|", (root / "inputs/README.md").read_text(), re.M))
    for name, said in others.items():
        if said != defaults.get(name):
            problem(f"inputs/README.md: {name} has the default {said}, fault.in {defaults.get(name)}")
    for name in ("paper_*.ini", "science_*.ini") + tuple(p.name for p in (root / "inputs").glob("*.in")):
        if name not in (root / "inputs/README.md").read_text() and not re.match(r"fault_\d+\.in", name):
            problem(f"inputs/README.md: no {name}")


# Page: sources with its keywords, words in them that are no keywords of the page, and where the defaults are
RUPTURES = "history slipping driving interval gap pause modulus quiet unfinished".split()
STYLES = {
    "create_lsm_fault": (["create_lsm_fault.cpp"], ["spacing"], ["core/lsm_packing.h"],
                         {"failures": "max_failures", "linkgap": "link_gap", "faultzone": "fault_zone"}),
    "fix_lsm_nve": (["fix_lsm_nve.cpp"], ["error", "warn", "off"], [], {}),
    "fix_lsm_plates": (["fix_lsm_plates.cpp"], [], [], {}),
    "fix_lsm_leap": (["fix_lsm_leap.cpp"], [], ["LSM/fix_lsm_leap.h"], {"settle": "viscosity", "look": "between"}),
    "compute_lsm_events": (["support/lsm_event_options.cpp", "../core/events/pe_drops.h"], RUPTURES,
                           ["core/events/event_kind.h", "core/events/pe_drops.h", "LSM/support/lsm_event_options.h", "core/lsm_watchdog.h",
                            "core/lsm_event_picker.h"],
                           {"stride": "series_stride", "bin": "bin_width", "strainlimit": "strain_limit", "check": "every",
                            "minsize": "min_size"}),
    "compute_lsm_events_ruptures": (["support/lsm_event_options.cpp", "../core/events/ruptures.h"], ["events", "picker", "lambda", "memory"],
                                    ["core/events/event_kind.h", "core/events/ruptures.h"], {"bin": "bin_width"}),
    "check_restart": (["check_restart.cpp"], [], [], {}),
    "check_variable": (["check_variable.cpp"], ["among"], [], {}),
}


def check_styles(root):
    package = root / "lammps-pkg"
    for page, (sources, others, headers, members) in STYLES.items():
        text = (package / f"doc/{page}.rst").read_text()
        code = "".join((package / "LSM" / source).read_text() for source in sources)
        keywords = set(re.findall(r'(?:key|keyword|kind|in\.key\(\)) [=!]= "([a-z/0-9]+)"', code))
        keywords |= set(re.findall(r'strcmp\(arg\[\w+\], "([a-z/]+)"\) == 0', code))
        keywords |= set(re.findall(r'\{"([a-z/]+)", (?:&[\w.]+(?:, Must::\w+(?:, &\w+)?)?\}|(?:LSM::)?(?:Words|Action)\{)', code))
        keywords -= set(others)
        said = set(re.findall(r"^       \*([a-z/]+)\* (?:value|=)", text, re.M)) | set(re.findall(r"^       \*([a-z/]+)\* values", text, re.M))
        assert len(keywords) > 1, (page, keywords)
        for keyword in sorted(keywords):
            if f"*{keyword}*" not in text.split("Examples\n")[0] and f" {keyword} " not in text.split("Examples\n")[0]:
                problem(f"{page}.rst: no keyword {keyword}")
        for keyword in sorted(said - keywords - set(others)):
            if f'"{keyword}"' not in code:
                problem(f"{page}.rst: keyword {keyword} is unknown to {', '.join(sources)}")
        heads = "".join((package / header).read_text() for header in headers)
        default = text.split('Default\n"""""""')[-1].split("----------")[0]
        for keyword, number in re.findall(r"([a-z]+)\s+=\s+([-+.0-9e]*[0-9])\b", default):
            member = members.get(keyword, keyword)
            found = re.search(r"\b%s(?:_time)?(?:\{| = |\()([-+.0-9e]+)" % member, heads)
            if not found and page not in ("fix_lsm_nve", "fix_lsm_plates", "create_lsm_fault"):
                problem(f"{page}.rst: no default of {keyword} in {', '.join(headers)}")
            if found and float(found[1]) != float(number):
                problem(f"{page}.rst: {keyword} = {number}, {', '.join(headers)} have {found[1]}")
    for page in sorted((package / "doc").glob("*.rst")):
        if page.stem != "index" and f"   {page.stem}\n" not in (package / "doc/index.rst").read_text():
            problem(f"index.rst: no {page.stem}")
        if page.stem != "index" and "   # Complete input: " not in page.read_text():
            problem(f"{page.name}: no complete input")


def folded(line):
    """A line of a help text in at most 100 columns."""
    start = re.match(r" *", line)[0]
    later = " " * 34 if re.match(r"  \S.*?  ", line) or len(start) > 20 else start
    return "\n".join(textwrap.wrap(line.strip(), 100, initial_indent=start, subsequent_indent=later, break_long_words=False,
                                   break_on_hyphens=False) or [""]) if len(line) > 100 else line


def help_page(program):
    """All options of a program, as its --help prints them."""
    def ask(*words):
        said = subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True).stdout.strip("\n")
        return "\n".join(folded(line.rstrip()) for line in said.splitlines())
    name = Path(program).name
    first = ask()
    parts = [f"# Options of {name}\n\nAs printed by `--help`; a test compares.\n\n```\n{first}\n```"]
    commands = re.search(r"^SUBCOMMANDS:\n(.*)", first, re.S | re.M) or re.search(r"^Subcommands:\n(.*)", first, re.S | re.M)
    for command in re.findall(r"^  ([a-z]\w*)", commands[1], re.M) if commands else []:
        parts.append(f"## {command}\n\n```\n{ask(command)}\n```")
    return "\n\n".join(parts) + "\n"


def main(root, programs, write):
    for program in programs:
        page = root / {"slider_cli": "slider", "postproc": "postproc"}[Path(program).name] / "options.md"
        text = help_page(program)
        if write:
            page.write_text(text)
        elif not page.exists() or page.read_text() != text:
            problem(f"{page.relative_to(root)} is not what {Path(program).name} --help prints: {Path(__file__).name} ... --write makes it")
    check_markdown(root)
    check_comments(root)
    check_scenes(root)
    check_variables(root)
    check_styles(root)
    print("\n".join(PROBLEMS) or "the documents agree with the programs")
    return bool(PROBLEMS)


if __name__ == "__main__":
    words = sys.argv[1:]
    writing = words[-1:] == ["--write"]
    if not words:
        sys.exit(__doc__)
    words = words[:-1] if writing else words
    sys.exit(main(Path(words[0]).resolve(), words[1:], writing))
