# SPDX-License-Identifier: GPL-2.0-or-later
"""What programs of the module lsm (python3 -m lsm.NAME) have in common."""
import json
import math
import sys

__all__ = ["add_time_window", "run", "write_json"]


def add_time_window(options):
    """Options --from and --to, which become `begin` and `end`."""
    options.add_argument("--from", dest="begin", type=float, default=-math.inf, metavar="TIME", help="leave out what starts before (model time)")
    options.add_argument("--to", dest="end", type=float, default=math.inf, metavar="TIME", help="leave out what starts at this time or later")


def write_json(path, content):
    """Writes a file as JSON. \\raises OSError that names the file, on a full disk as well"""
    try:
        with open(path, "w", encoding="utf-8") as file:
            file.write(json.dumps(content, indent=1) + "\n")
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None


def run(main, options):
    """Calls main with the options of the command line; what it refuses ends the program with one line of error."""
    name = options.prog.split()[-1]
    try:
        main(**vars(options.parse_args()))
    except OSError as error:
        sys.exit(f"{name}: {error.filename}: {error.strerror}")
    except ValueError as error:
        sys.exit(f"{name}: {error}")
