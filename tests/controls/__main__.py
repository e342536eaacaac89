"""`python -m tests.controls [FILE]`: the table of the negative controls, by all checks, to a file or to standard output."""

from __future__ import annotations

import sys
from pathlib import Path

from tests.controls.court import convictions, findings, table
from tests.controls.sick import SICK


def main() -> None:
    """Tries every control; progress goes to stderr."""
    rows = []
    for sick in SICK:
        rows.append((sick, convictions(findings(sick.model, sick.values))))
        print(sick.name, ", ".join(rows[-1][1]), file=sys.stderr, flush=True)
    if len(sys.argv) > 1:
        Path(sys.argv[1]).write_text(table(rows) + "\n")
    else:
        print(table(rows))


if __name__ == "__main__":
    main()
