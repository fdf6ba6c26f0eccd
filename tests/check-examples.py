#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The complete input of each page of the package runs as it stands.

check-examples.py LMP DOC_DIR
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def main(lmp, folder):
    failed, count = [], 0
    for page in sorted(Path(folder).glob("*.rst")):
        for block in re.findall(r"\.\. code-block:: LAMMPS\n\n((?:   .*\n|\n)+)", page.read_text()):
            script = "".join(line[3:] + "\n" for line in block.splitlines())
            if not script.startswith("# Complete input: "):
                continue
            count += 1
            with tempfile.TemporaryDirectory() as work:
                Path(work, "in.example").write_text(script)
                run = subprocess.run([lmp, "-in", "in.example"], cwd=work, capture_output=True, text=True, timeout=120, stdin=subprocess.DEVNULL)
                if run.returncode or "Total wall time" not in run.stdout:
                    failed.append(f"{page.name} ended with {run.returncode}:\n{run.stdout[-2000:]}{run.stderr[-500:]}")
                else:
                    warnings = sorted(set(re.findall(r"^WARNING: .*", run.stdout, re.M)))
                    print(page.name, *warnings, sep="\n  ")
    if count < 15:
        failed.append(f"only {count} complete inputs in {folder}")
    print("\n".join(failed))
    return bool(failed)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1]).resolve(), sys.argv[2]))
