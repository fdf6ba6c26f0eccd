#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The documents say what the programs do.

check-documents.py SOURCE_DIR [PROGRAM...]

Links and anchors of Markdown pages exist; their lines and the comments of scenes and studies are
at most 100 columns wide; READMEs have at most 150 lines; the classes that ARCHITECTURE.md draws
exist; variables.md has the table of fault.variables; options.md of each program is what its --help
prints (--write as the last word writes both).
"""
import re
import subprocess
import sys
import textwrap
from pathlib import Path

PROBLEMS = []
problem = PROBLEMS.append


def tracked(root, *patterns):
    """The files of the project whose names match."""
    said = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", *patterns], cwd=root, capture_output=True, text=True)
    return [root / name for name in said.stdout.split() if (root / name).exists()]


def outside_code(text):
    """The lines of a Markdown page that are not within ``` fences, with their numbers."""
    inside = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            inside = not inside
        elif not inside:
            yield number, line


def anchor(heading):
    """The anchor that GitHub makes of a heading: lower case, no punctuation, hyphens for blanks."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r" ", "-", re.sub(r"[^\w\- ]", "", heading))


def anchors(page):
    return {anchor(line.lstrip("#")) for _, line in outside_code(page.read_text()) if line.startswith("#")}


def check_markdown(root):
    pages = tracked(root, "*.md") or [p for p in root.rglob("*.md") if "build" not in p.relative_to(root).parts]
    assert len(pages) > 15, pages
    for page in pages:
        name, text = page.relative_to(root), page.read_text()
        if page.name == "README.md" and len(text.splitlines()) > 150:
            problem(f"{name}: {len(text.splitlines())} lines, at most 150 expected")
        for number, line in outside_code(text):
            line = re.sub(r"<!--n .*?-->", "", line)  # keys of numbers, which readers do not see
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


def check_classes(root):
    picture = re.search(r"^## The classes.*?^```\n(.*?)^```", (root / "ARCHITECTURE.md").read_text(), re.S | re.M)[1]
    code = "".join(file.read_text() for part in ("lammps-pkg", "slider", "postproc") for file in (root / part).rglob("*.[ch]*")
                   if file.suffix in (".h", ".cpp"))
    names = re.findall(r"\b[A-Z]\w*[a-z][A-Z]\w*\b(?!\w*\.\.\.)", picture)
    assert len(names) > 40, names
    for name in names:
        if not re.search(rf"\b(class|struct|namespace) {name}\b", code):
            problem(f"ARCHITECTURE.md: the picture has {name}, expected a class or namespace")


def check_comments(root):
    for path in tracked(root, "*.in", "*.ini", "*.gp", "inputs/studies/*.csv", "inputs/*.yaml", "inputs/*.sh"):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if len(line) > 100 and re.match(r" *# \S", line) and "usage" not in line:
                problem(f"{path.relative_to(root)}:{number}: a comment of {len(line)} columns, at most 100 expected")


def check_scenes(root):
    for scene in sorted((root / "inputs").glob("*.in")) + sorted((root / "tests").rglob("*.in")):
        for number, line in enumerate(scene.read_text().splitlines(), 1):
            itself = re.search(r"\bvariable\s+(\w+)\s+string\s+'[^']*\$\{\1\}", line)
            if itself:
                problem(f"{scene.relative_to(root)}:{number}: variable {itself[1]} from its own value, which LAMMPS 4 Jul 2026 refuses")


def variable_table(root):
    """The table of variables.md, from the declarations that fault.in reads."""
    sys.path.insert(0, str(root / "inputs"))
    from variables import cases, declared
    name_of_restart = {"-": "run", "noted": "run", "free": "settings", "fixed": "fault"}

    def said(default):
        template = re.fullmatch(r"\$\((.*):%\.0f\)", default)
        if template:
            return "(" + re.sub(r"round\((.*)\)", r"\1", template[1]).replace("v_", "").replace("/", " / ") + ")"
        if "${" in default:
            return "(`" + default.replace("${", "").replace("}", "") + "`)"
        return "(none)" if default in ("", "-") else f"`{default}`"

    rows = []
    for one in declared():
        in_cases = "".join(f"; `{when}`: {said(value)}" for when, name, value in cases() if name == one.name)
        rows.append(f"| `{one.name}` | {said(one.default)}{in_cases} | {name_of_restart[one.restart]} | {one.unit} | {one.meaning} |")
    assert len(rows) > 40, rows
    return "| variable | default | of | unit | meaning |\n|---|---|---|---|---|\n" + "\n".join(rows) + "\n"


def check_variables(root, write):
    table = variable_table(root)
    page = root / "inputs/variables.md"
    text = re.sub(r"(?m)^\| variable .*\n(\|.*\n)+", lambda _: table, page.read_text())
    if write:
        page.write_text(text)
    elif page.read_text() != text:
        problem(f"inputs/variables.md is not what fault.variables says: {Path(__file__).name} ... --write makes it")
    for name in ("paper_*.ini", "science_*.ini") + tuple(p.name for p in (root / "inputs").glob("*.in")):
        if name not in (root / "inputs/README.md").read_text() and not re.match(r"fault_\d+\.in", name):
            problem(f"inputs/README.md: no {name}")


def folded(line):
    """A line of a help text in at most 100 columns."""
    start = re.match(r" *", line)[0]
    later = " " * 34 if re.match(r"  \S.*?  ", line) or len(start) > 20 else start
    return "\n".join(
        textwrap.wrap(line.strip(), 100, initial_indent=start, subsequent_indent=later, break_long_words=False, break_on_hyphens=False) or
        [""]) if len(line) > 100 else line


def help_page(program):
    """All options of a program, as its --help prints them. What several commands have is there once."""

    def ask(*words):
        said = subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True).stdout.strip("\n")
        return re.sub(r"\n{3,}", "\n\n", "\n".join(folded(line.rstrip()) for line in said.splitlines()))

    name, first = Path(program).name, ask()
    top = f"# Options of {name}\n\nAs printed by `--help`; a test compares."
    listed = re.search(r"^Subcommands:\n((?:  .*\n)+)\n?", first, re.M)
    if not listed:
        return f"{top}\n\n```\n{first}\n```\n"
    said = {command: ask(command) for command in re.findall(r"^  ([a-z]\w*)", listed[1], re.M)}
    option = re.compile(r"^  \S.*\n(?: {8,}\S.*\n)*", re.M)
    having = {}
    for command, text in said.items():
        for one in option.findall(text + "\n"):
            having.setdefault(one, []).append(command)
    shared = {}
    for one, commands in having.items():
        if len(commands) > 1:
            shared.setdefault(tuple(commands), []).append(one)
    several = "Options of several commands"
    parts = [
        f"{top} [{several}](#{anchor(several)}) are at the end.", "```\n" + first.replace(listed[0], f"Subcommands: {', '.join(said)}\n\n") + "\n```"
    ]
    parts[-1] = "\n".join(folded(line) for line in parts[-1].splitlines())
    for command, text in said.items():
        own = option.sub(lambda one: "" if len(having[one[0]]) > 1 else one[0], re.sub(r"\nUsage: .*", "", text) + "\n")
        own = re.sub(r"^\S[^\n]*:\n\n+(?=\S|\Z)", "", own.rstrip("\n") + "\n\n", flags=re.M).rstrip("\n")
        parts.append(f"## {command}\n\n```\n{own}\n```")
    parts.append(f"## {several}")
    for commands, options in sorted(shared.items(), key=lambda entry: -len(entry[0])):
        of = "all commands" if len(commands) == len(said) else ", ".join(commands)
        if 2 * len(commands) > len(said) > len(commands):
            of = "all commands but " + ", ".join(command for command in said if command not in commands)
        parts.append(f"### Of {of}\n\n```\n{''.join(options)}```")
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
    check_classes(root)
    check_comments(root)
    check_scenes(root)
    check_variables(root, write)
    print("\n".join(PROBLEMS) or "the documents agree with the programs")
    return bool(PROBLEMS)


if __name__ == "__main__":
    words = sys.argv[1:]
    writing = words[-1:] == ["--write"]
    if not words:
        sys.exit(__doc__)
    words = words[:-1] if writing else words
    sys.exit(main(Path(words[0]).resolve(), words[1:], writing))
