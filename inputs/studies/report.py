#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""One self-contained HTML page on a set of catalogues: counts, figures (SVG), fits, finite-size scaling, Table 1, parameters, and what of
it is not in the paper. Numbers, texts and figures are those of the commands of postproc and of lsm.scaling.

report.py [--postproc PROGRAM] [-o PAGE] [--title TITLE] [--label NAME]... [--from TIME]... [--threshold SIZE] [--lenient]
          [--replicas N] CATALOGUE...
"""
import argparse
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
PYTHON = Path(__file__).resolve().parent.parent.parent / "python"  # of a checkout
sys.path.insert(0, str(PYTHON))
from lsm import lines_of  # noqa: E402
from lsm.tables import header_of  # noqa: E402

GENERATOR = '<meta name="generator" content="report.py">'
MODELS = {"lsm": "Fault", "block-slider": "Block-slider", "earthquakes": "Earthquakes"}
# The exponents that the paper prints. Where they hold it does not say; the ranges are ours, where they are seen.
GUIDES = {"lsm": ["--guide=-1.07:1e-4:0.1"], "block-slider": ["--guide=-0.5:1e-2:1", "--guide=-1:1:100"]}
RANGES = {"block-slider": ["--range", "1e-2:1", "--range", "1:100"]}
FIGURES = {"lsm": (12, 14), "block-slider": (13, 15)}
PRINTED = {
    "lsm": "The paper (Sect. 4.2) prints the exponent 1.07 over about 3 decades of the sizes of the LSM; how it was fitted is not stated.",
    "block-slider": "The paper (Sect. 4.2) prints the exponents about 1.0 for moderate sizes of the Block-Slider, over about 3 decades, and about "
    "0.5 for small ones; how they were fitted is not stated.",
}
KINDS = {
    "pe": "Sizes are drops of the potential energy of the whole model, so that ruptures at the same time at different places are one event. In long "
    "models more of them are joined: growth of s* from this is no finite-size effect.",
    "ruptures": "Events are ruptures †: connected in space and time, so that those at the same time at different places stay apart. The events of "
    "the paper are drops of the total potential energy, so its exponents and times are about another quantity.",
}


def parameters_of(path):
    """The header of a catalogue of a model; {} for earthquakes. \\raises OSError"""
    lines = lines_of(path)
    return header_of(lines) if lines and lines[0].startswith("# lsm-catalogue") else {}


class Postproc:
    """Runs commands of postproc in a folder of its own."""

    def __init__(self, program, folder, options):
        self.program, self.folder, self.options, self.pictures = program, Path(folder), options, 0

    def __call__(self, command, *words):
        """What a command prints, or a program of the module lsm, without the names of its files. \\raises ValueError with its line of error"""
        program = [sys.executable, "-m"] if command.startswith("lsm.") else [self.program]
        where = {**os.environ, "PYTHONPATH": f"{PYTHON}:{os.environ.get('PYTHONPATH', '')}"}
        done = subprocess.run([*program, command, *map(str, words), *self.options], capture_output=True, text=True, env=where)
        if done.returncode:
            raise ValueError(done.stderr.strip().removeprefix("postproc: "))
        return "".join(line + "\n" for line in done.stdout.splitlines() if not line.startswith("wrote ")) + done.stderr

    def figure(self, title, caption):
        """The picture drawn last, as an element of the page; its identifiers must differ from those of others."""
        self.pictures += 1
        svg = (self.folder / "out.svg").read_text()
        svg = re.sub(r"""( id=["']|href=["']#|url\(#)""", rf"\1f{self.pictures}-", svg[svg.index("<svg"):svg.index("</svg>") + 6])
        svg = re.sub("<title>.*?</title>", f"<title>{html.escape(title)}</title>", svg, count=1, flags=re.S)
        svg = re.sub("<desc>.*?</desc>", "", svg, count=1, flags=re.S).replace('fill="#ffffff"', 'fill="none"', 1)
        return (f'<figure>\n<div class="wide"><svg role="img"{svg[4:]}</div>\n'
                f"<figcaption><b>{html.escape(title)}.</b> {caption}</figcaption>\n</figure>\n")


def preformatted(text):
    return f'<div class="wide"><pre>{html.escape(text)}</pre></div>\n'


def section(postproc, files, labels, model, kind, settings):
    """Sizes, scaling and times of the catalogues of one model and kind of events; where there is nothing to draw or to fit, why."""
    named = [*files, *(f"--label={label}" for label in labels), "-o", postproc.folder / "out"]
    least, replicas = ["--threshold", settings.threshold] if settings.threshold else [], ["--replicas", settings.replicas]
    of_sizes, of_times = (f"Compare with Fig. {n} of the paper. " if kind == "pe" else "" for n in FIGURES.get(model, ("", "")))
    times = ["intervals", *named, *least, "--delta", 1, "--shuffles", 0, "--method", "likelihood", "--seed", 1]
    said = f"<p>{PRINTED[model]} Ours is by maximum likelihood on a range with both ends.</p>\n" if model in PRINTED and kind == "pe" else ""
    # What stands before, what is shown of a command, the command, title and caption of its figure
    parts = [
        (f"<h3>Event sizes</h3>\n<p>{KINDS.get(kind, '')}</p>\n", "figure", ["histograms", *named, *least, *GUIDES.get(model, [])],
         "Densities of event sizes", f"{of_sizes}Straight lines: the paper's exponents; their ranges are †. Ten bins a "
         "decade, count / (N width), Poisson errors (one decade down where they reach zero)."),
        (said, "text", ["fit", *named, *least, "--seed", 1, *replicas]),
        ("", "text", ["fit", *named, "--seed", 1, *replicas, *RANGES.get(model, [])]),
        ("<h3>Finite-size scaling</h3>\n", "text figure", ["lsm.scaling", *named, *least, "--seed", 1], "Characteristic size against length",
         "Ours: s* = &lt;s²&gt; / &lt;s&gt; follows the roll-off of the sizes; errors by resampling blocks of time; lines: weighted fits."),
        ("<h3>Inter-event times</h3>\n", "figure text", [*times, *replicas], "Densities of inter-event times",
         f"{of_times}Start to start; lines: fitted generalised gamma densities, maximum likelihood with δ = 1 where that is not degenerate."),
        ("", "figure", [*times, "--replicas", 0, "--rescale"], "Inter-event times divided by their mean",
         "Not in the paper; the scaling in which Corral (2004) found the distribution of seismicity to be universal."),
    ]  # yapf: disable
    out = ""
    for before, shown, words, *figure in (part for n, part in enumerate(parts) if (n != 2 or model in RANGES) and (n != 3 or model != "earthquakes")):
        out += before
        try:
            text = postproc(*words)
            made = dict(text=lambda: preformatted(text), figure=lambda: postproc.figure(*figure))
            out += "".join(made[one]() for one in shown.split())
        except ValueError as error:
            out += f'<p class="bad">{html.escape(str(error))}</p>\n'
        for path in postproc.folder.glob("out*"):
            path.unlink()
    return out


def parameter_table(headers):
    """Parameters of all catalogues, as the programs wrote them."""
    keys = list(dict.fromkeys(key for header in headers for key in header))
    rows = "".join(f'<tr><th scope="row">{html.escape(key)}</th>' + "".join(f"<td>{html.escape(h.get(key, '–'))}</td>" for h in headers) + "</tr>\n"
                   for key in keys)
    return f'<div class="wide"><table>\n{rows}</table></div>\n'


def page_of(settings, folder):
    """The whole page, which needs no other file and no network. \\raises OSError, ValueError"""
    begin, paths = settings.begin or [], list(settings.catalogues)
    if len(begin) > 1 and len(begin) != len(paths):
        raise ValueError(f"--from given {len(begin)} times, expected once, or once for each of {len(paths)} catalogues")
    own = len(begin) > 1
    options = [f"--from={one}" for one in begin if not own]
    postproc = Postproc(settings.postproc, folder, options + ["--lenient"] * settings.lenient)
    labels = settings.label or []
    if labels and len(labels) != len(settings.catalogues):
        raise ValueError(f"--label given {len(labels)} times, expected once for each of {len(settings.catalogues)} catalogues")
    for n, path in enumerate(paths if own else []):
        if begin[n] != "0":
            paths[n] = Path(folder, str(n), re.sub("[.](gz|xz)$", "", Path(path).name))
            paths[n].parent.mkdir()
            postproc("select", path, f"--from={begin[n]}", "-o", paths[n])
    counts = preformatted(postproc("count", *paths, *(f"--label={label}" for label in labels), "--json", folder / "count.json"))
    names = [row["label"] for row in json.loads((folder / "count.json").read_text())["catalogues"]]
    groups = {}
    for n, path in enumerate(paths):
        header = parameters_of(path)
        model = header.get("model", "earthquakes")
        # Sliders of other leaf springs are other models: their sizes differ more than those of other lengths.
        key = (model, header.get("events", "pe" if header else ""), header.get("kl", "") if model == "block-slider" else "")
        groups.setdefault(key, []).append((path, names[n], header))
    models = contents = parameters = ""
    several = {model for model, _, kl in groups if len({k for m, _, k in groups if m == model}) > 1}
    for number, key in enumerate(sorted(groups, key=lambda key: (list(MODELS).index(key[0]), key[1:])), 1):
        model, kind, kl = key
        paths, some, headers = zip(*groups[key])
        heading = MODELS[model] + (f": {kind}" if kind not in ("pe", "") else "") + (f", k_l = {kl}" if model in several else "")
        contents += f'<li><a href="#model-{number}">{html.escape(heading)}</a></li>\n'
        models += f'<h2 id="model-{number}">{html.escape(heading)}</h2>\n{section(postproc, paths, some, model, kind, settings)}'
        if any(headers):
            parameters += f"<h3>{html.escape(heading)}</h3>\n<p>{html.escape('; '.join(some))}</p>\n{parameter_table(headers)}"
    values = dict(title=html.escape(settings.title), contents=contents, catalogues=counts, models=models, parameters=parameters,
                  replicas=str(settings.replicas), generator=GENERATOR)
    template = Path(__file__).with_name("report.html").read_text()
    return re.sub(r"{{(\w+)}}", lambda found: values[found[1]], template)


def main(settings):
    page = Path(settings.output)
    if page.is_dir():
        raise ValueError(f"{page}: is a directory, expected a file name")
    if any(page.exists() and page.samefile(path) for path in settings.catalogues if Path(path).exists()):
        raise ValueError(f"{page}: is read by this program, expected another name")
    if page.exists() and GENERATOR not in page.read_text(errors="replace")[:1000]:
        raise ValueError(f"{page} exists and is no page of this program, expected another name")
    if not shutil.which(settings.postproc):
        raise ValueError(f"{settings.postproc}: no such program, expected postproc (--postproc)")
    if not shutil.which("gnuplot"):
        raise ValueError("gnuplot not found (Debian package gnuplot-nox)")
    with tempfile.TemporaryDirectory() as folder:
        text = page_of(settings, Path(folder))
    new = page.with_name(page.name + ".new")
    new.write_text(text)
    new.replace(page)
    print(f"wrote {page}")


def parser():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("catalogues", nargs="+", metavar="CATALOGUE")
    options.add_argument("--postproc", default="postproc", metavar="PROGRAM")
    options.add_argument("-o", "--output", default="report.html", metavar="PAGE")
    options.add_argument("--title", default="Event statistics of the fault and the block-slider")
    options.add_argument("--label", action="append", help="name of a curve, once per catalogue")
    options.add_argument("--from", dest="begin", action="append", metavar="TIME",
                         help="leave out what starts before; once, or once per catalogue of a model (0: nothing)")
    options.add_argument("--threshold", metavar="SIZE", help="smallest size of the events; without it that of postproc")
    options.add_argument("--lenient", action="store_true", help="skip lines that cannot be read")
    options.add_argument("--replicas", type=int, default=100, help="synthetic samples of p-values; 0: none")
    return options


if __name__ == "__main__":
    try:
        main(parser().parse_args())
    except (OSError, ValueError) as error:
        sys.exit(f"report.py: {error}")
