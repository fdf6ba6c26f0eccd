# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of Python programs on the module lsm. gnuplot draws."""
import csv
import math
import subprocess
from pathlib import Path
from typing import NamedTuple

__all__ = ["KEY", "Figure", "axis", "draw", "draw_all", "quote"]

STYLE = """set datafile separator comma
set encoding utf8
colours = "#0072B2 #D55E00 #009E73 #CC79A7 #E69F00 #56B4E9 #7A6A00 #000000" # of Okabe and Ito
points = "7 5 9 13 4 6 8 12"
do for [n = 1:8] { set linetype n lc rgb word(colours, n) pt int(word(points, n)) dt 1 lw 1.6 ps 0.9*point }
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid xtics ytics lt 1 dt 1 lw 0.5 lc rgb "#d8d8d8"
"""
KEY = "set key outside bottom center horizontal samplen 3 spacing 1.15 maxcols 2 width -3 Left reverse height 1\n"


class Figure(NamedTuple):
    """A table and the script that draws it. rows: lists of cells; comments[0] says what it is."""
    ending: str
    comments: list
    names: str
    rows: list
    script: str = ""  # "": a table only
    size: tuple = (900, 600)


def quote(text, markup=False):
    """A text for gnuplot, which runs backquotes and counts braces: what is not known to be harmless becomes octal numbers.

    markup: the text has markup of our own, such as 10^{3}
    """
    out = ""
    for c in text:
        if not markup and c in "\\{}^_@&~":
            out += "\\134"
        harmless = ord(c) >= 128 or c.isalnum() or c in " .,:;()=+-/*%<>!?" or markup and c in "_^{}"
        after_octal = c.isdigit() and len(out) > 3 and out[-4] == "\\"
        out += c if harmless and not after_octal else " " if c < " " else f"\\{ord(c):03o}"
    return f'"{out}"'


def ticks_around(lo, hi):
    """Ticks from the last one not above lo to the first one above hi: powers of ten times 1, 2 and 5, or more digits if these are few."""
    for digits in (1, 2, 5), (1, 2, 3, 4, 5, 7), (1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9):
        every = [float(f"{digit}e{n}") for n in range(math.floor(math.log10(lo)) - 1, math.floor(math.log10(hi)) + 2) for digit in digits]
        ticks = [a for a, after in zip(every, every[1:]) if after > lo and a <= hi] + [next(tick for tick in every if tick > hi)]
        if len(ticks) >= 4:
            break
    return ticks


def axis(name, label, lo=math.nan, hi=math.nan, logarithmic=False):
    """Lines that label an axis and set its ends: where they are logarithmic, the next powers of ten, or of ticks if these are near."""
    out = f"set {name}label {quote(label, True)}\n"
    if logarithmic and hi < 30 * lo:
        ticks = ticks_around(lo, hi)
        lo, hi = ticks[0], ticks[-1]
        out += f"set logscale {name}\nset {name}tics ({', '.join(f'{tick:g}' for tick in ticks)})\n"
    elif logarithmic:
        lo, hi = 10.0**math.floor(math.log10(lo) + 1e-9), 10.0**math.ceil(math.log10(hi) - 1e-9)
        hi = max(hi, 10 * lo)
        out += f"set logscale {name}\nset format {name} '10^{{%L}}'\nset {name}tics {100 if hi / lo > 10**12.5 else 10}\n"
    return out if math.isnan(lo) else out + f"set {name}range [{lo:.15g}:{hi:.15g}]\n"


def draw(base, script, width, height):
    """Draws BASE.png and BASE.svg with a script for gnuplot, in which `table` is BASE.csv. \\raises ValueError"""
    standalone = "standalone " * ("with image" in script)  # without it gnuplot writes images to files of their own
    path = quote(str(base) if Path(base).is_absolute() else f"./{base}", True)
    for ending, head in (("png", f"point = 1.0; set terminal pngcairo size {2 * width},{2 * height} font 'DejaVu Sans,26' linewidth 2 pointscale 2"),
                         ("svg", f"point = 0.65; set terminal svg size {width},{height} dynamic {standalone}font 'DejaVu Sans,13'")):
        text = f"{head} enhanced background '#ffffff'\n{STYLE}base = {path}\ntable = base.'.csv'\nset output base.'.{ending}'\n{script}\nunset output\n"
        try:
            done = subprocess.run(["gnuplot", "-d"], input=text, capture_output=True, text=True)
        except FileNotFoundError:
            raise ValueError("gnuplot not found (Debian package gnuplot-nox)") from None
        if done.returncode:
            raise ValueError(f"gnuplot: {done.stderr.strip().splitlines()[-1]}")


def draw_all(program, base, figures, inputs, picture):
    """Writes tables and pictures; nothing if a table would replace a file of something else. \\raises ValueError"""
    made = f"made by {program}: "
    for one in figures:
        path = Path(f"{base}{one.ending}.csv")
        if path.exists() and (any(path.samefile(name) for name in inputs) or not path.read_bytes().startswith(f"# {made}".encode())):
            raise ValueError(f"{path} exists and is not from an earlier run of this program, expected another -o")
    for one in figures:
        with open(f"{base}{one.ending}.csv", "w", newline="", encoding="utf-8") as file:
            file.writelines(f"# {line}\n" for line in [made + one.comments[0], *one.comments[1:]])
            table = csv.writer(file, lineterminator="\n")
            table.writerow(one.names.split(","))
            table.writerows([("" if cell != cell else f"{cell:.12g}") if isinstance(cell, float) else cell for cell in row] for row in one.rows)
    for one in figures:
        if one.script and picture:
            draw(f"{base}{one.ending}", one.script, *one.size)
        print(f"wrote {base}{one.ending}.csv" + ", .png, .svg" * bool(one.script and picture))
