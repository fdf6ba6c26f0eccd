# SPDX-License-Identifier: GPL-2.0-or-later
"""Report pages and the paper's figures as files. The faults are loaded from zero until time 7000 or so, and the tables of results
begin after `LOADING`, at 8000. Ruptures of the sliders are steady from time 40000 on in our settings."""
from default import costs
from lsm import LOADING
from recipes import fit_command, times_command

PAPER = "(256|614|972|1450|1928)"


def _loaded(study):
    return LOADING if study.shorten < 2 else 0


def numbers(run):
    begin = _loaded(run) if run.program == "fault" else 0
    window = f"--from {begin:.15g}" if begin else ""
    return {
        "count": f"count {run.catalogue} {window} --size 1e-3 --size 1",
        "fit": fit_command(run.catalogue, window),
        "times": times_command(run.catalogue, window),
    }


def table(run, found):
    all_of, fit, times = found.count.catalogues[0], found.fit.fits[0], found.times.fits[0]
    return dict(events=all_of.events, largest=all_of.largest, exponent=fit.exponent, exponent_error=fit.standard_error, from_size=fit.lo,
                to_size=fit.hi, gamma=times.gamma, gamma_error=times.gamma_error)


def figures(study):
    begin = f"--from {_loaded(study):.15g}"
    sliders = f"^slider_ours_{PAPER}_1$"
    return {
        "fig7_leaf_springs": dict(runs="^slider_kl|^slider_ours_1928_1$", command="histograms"),
        "fig12_fault_sizes": dict(runs="^fault_[0-9]*_1$", command=f"histograms {begin} --threshold 1e-4 --guide=-1.07:1e-4:0.1"),
        "fig13_slider_sizes": dict(runs=sliders, command="histograms --guide=-0.5:1e-2:1 --guide=-1:1:100"),
        "fig14_fault_intervals": dict(runs="^fault_[0-9]*_1$", command=f"intervals {begin} --threshold 1e-4 --delta 1"),
        "fig15_slider_intervals": dict(runs=sliders, command="intervals"),
        "fault_fit": dict(runs="^fault", command=f"fit {begin} --threshold 1e-3 --range 1e-3:1e-1 --range 1e-3:1"),
        "slider_fit": dict(runs=sliders, command="fit --range 0.01:1 --range 1:100"),
        "rupture_fit": dict(runs="^slider_ruptures", command="fit --range 1:100 --from 40000 --threshold 0.1 --replicas 0"),
        "fault_scaling": dict(runs="^fault", command=f"lsm.scaling {begin} --threshold 1e-3"),
        "slider_scaling": dict(runs=sliders, command="lsm.scaling"),
        "rupture_scaling": dict(runs="^slider_ruptures", command="lsm.scaling --from 40000 --threshold 0.1"),
    }


def _model(run):
    """Packings of a fault are one model."""
    return (run.name.rsplit("_", 1)[0] if run.name.startswith("fault") else run.name).replace("_", " ")


def pages(study):
    return {
        "report": dict(runs=f"^fault|^slider_ours_{PAPER}_1$|^slider_kl", title="Faults, and block-sliders in our settings",
                       begin=lambda run: _loaded(run) if run.program == "fault" else 0, label=_model),
        "report_ruptures": dict(runs="^slider_ruptures_[0-9]*_1$", title="Block-sliders, ruptures as events, our settings"),
        "report_paper_settings": dict(runs=f"^slider_paper_{PAPER}_1$", title="Block-sliders as printed in the paper"),
        "report_long_chains": dict(runs="^slider_ours_[0-9]*_1$", title="Block-sliders longer than the paper's, our settings"),
        "report_seed_2": dict(runs="^slider_ours_[0-9]*_2$", title="Block-sliders in our settings, seed 2"),
        "report_seed_3": dict(runs="^slider_ours_[0-9]*_3$", title="Block-sliders in our settings, seed 3"),
    }
