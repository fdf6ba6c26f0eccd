#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# 'from lammps import lammps' with the package: the fault run from Python leaves the files that lmp
# leaves, errors are exceptions, files are unlocked again, and the lines of python.md do what they
# say.
# usage: check-python.sh MODULES LMP INPUTS [MPIRUN]
set -euo pipefail
export LC_ALL=C
modules=$1 lmp=$2 inputs=$3 mpirun=${4:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*"; [ ! -f out ] || tail -n 20 out; exit 1; }

cat >fault.py <<'END'
import sys
from lammps import lammps

words = ["-log", "none", "-screen", "none"]
settings = dict(length=20, width=15, settle=100, steps=600, velocity=0.01)


def fault(**more):
    run = lammps(cmdargs=words + [word for key, value in {**settings, **more}.items() for word in ("-var", key, str(value))])
    run.file(sys.argv[1] + "/fault.in")
    return run


run = fault(prefix="python")
assert "LSM" in run.installed_packages and run.has_style("compute", "lsm/events")
assert run.extract_global("natoms") > 500
assert run.extract_compute("events", 0, 0) == run.extract_variable("events")
links = run.extract_compute("events", 0, 1)[5]
assert 0.0 < links < 1.0, links
# Still being written by that object.
try:
    fault(prefix="python", overwrite="yes")
except Exception as error:
    assert "python.catalogue.csv: this run writes that file already" in str(error), error
else:
    raise AssertionError("two objects write one catalogue")
run.close()
run = fault(prefix="again")
run.close()
run.finalize()
END
python=(env PYTHONPATH="$modules" python3 fault.py "$inputs")
"${python[@]}" >out 2>&1 || fail "fault.py"
"$lmp" -in "$inputs/fault.in" -log none -var length 20 -var width 15 -var settle 100 -var steps 600 -var velocity 0.01 -var prefix lmp \
  </dev/null >out 2>&1 || fail "lmp"
for name in python again; do
  [ ! -e $name.catalogue.csv.lock ] || fail "$name left its lock"
  cmp $name.catalogue.csv lmp.catalogue.csv && cmp $name.pe.bin lmp.pe.bin || fail "$name left other files than lmp"
done
if [ -n "$mpirun" ]; then
  rm ./*.csv ./*.bin ./*.restart.*
  "$mpirun" --oversubscribe -np 2 "${python[@]}" </dev/null >out 2>&1 || fail "fault.py on two ranks"
fi

# The page: a fault, its catalogue, series, ruptures and slip, read by pandas where that is
# installed
if python3 -c 'import pandas' 2>/dev/null; then
  mkdir page
  ln -s "$inputs" page/inputs
  sed -n '/^```python$/,/^```$/{/^```/d;p}' "$inputs/python.md" > page/page.py
  cat >>page/page.py <<'END'
assert list(events.columns)[:6] == ["event_id", "t_start", "t_end", "step_start", "step_end", "size"]
assert len(events) > 0 and (events["size"] > 0).all() and len(series) > 3000
drop = series.set_index("step")["pe"]
assert np.allclose(drop[events["step_start"]].values - drop[events["step_end"]].values, events["size"], rtol=1e-9, atol=1e-15)
assert np.allclose(series["time"].values, series["step"] * float(header["dt"]))
assert history["step_end"].max() <= 3100 and slip.shape == (bins,) and velocity.shape[1] == bins
assert len(ruptures) > 0 and slip.mean() > 0
END
  (cd page && PYTHONPATH="$modules" python3 page.py >out 2>&1) || { cat page/out; fail "the lines of python.md"; }
else
  echo "no pandas (Debian package python3-pandas): the lines of python.md were not run"
fi
