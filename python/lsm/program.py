# SPDX-License-Identifier: GPL-2.0-or-later
"""What programs of the module lsm (python3 -m lsm.NAME) have in common."""
import math
import sys

__all__ = ["add_time_window", "run"]


def add_time_window(options):
    """Options --from and --to, which become `begin` and `end`."""
    options.add_argument("--from", dest="begin", type=float, default=-math.inf, metavar="TIME", help="leave out what starts before (model time)")
    options.add_argument("--to", dest="end", type=float, default=math.inf, metavar="TIME", help="leave out what starts at this time or later")


def run(main, options):
    """Calls main with the options of the command line; what it refuses ends the program with one line of error."""
    name = options.prog.split()[-1]  # of a module or a file
    try:
        main(**vars(options.parse_args()))
    except OSError as error:
        sys.exit(f"{name}: {error.filename}: {error.strerror}")
    except ValueError as error:
        sys.exit(f"{name}: {error}")
