"""Cases that are worked on several at once, and shares of them for the jobs of an array.

Each case waits for a process of its own, so threads suffice.
"""

import argparse
import concurrent.futures
import re

from .option_types import at_least_one


def declare_jobs(parser, what):
    parser.add_argument("--jobs", type=at_least_one, default=1, metavar="N", help=f"{what} at once; 1 if not given")


def declare_part(parser, what):
    parser.add_argument(
        "--part", type=_part, metavar="K/N", help=f"every Nth of the {what} from the Kth on: one job of an array"
    )


def share(cases, part):
    """Those of a part (K, N) of all cases; all if there is no part."""
    if part is None:
        return cases
    first, step = part
    return cases[first - 1 :: step]


def at_once(work, cases, jobs):
    """Yields work(case) of all cases in their order, `jobs` at a time. What is not begun when one
    fails, or when nobody wants more, is not begun any more."""
    if jobs == 1:
        yield from map(work, cases)
        return
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        futures = [pool.submit(work, case) for case in cases]
        try:
            for future in futures:
                yield future.result()
        finally:
            for future in futures:
                future.cancel()


def _part(text):
    """(K, N) of 'K/N', 1 <= K <= N."""
    match = re.fullmatch(r"(\d+)/(\d+)", text)
    if not match or not 1 <= int(match[1]) <= int(match[2]):
        raise argparse.ArgumentTypeError(f"needs K/N with K from 1 to N, got '{text}'")
    return int(match[1]), int(match[2])
