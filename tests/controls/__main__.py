"""`python -m tests.controls [FILE]`: tries every negative control by all checks and writes the page about them."""

from __future__ import annotations

import sys
from pathlib import Path

from albedo_lab.files import write_whole
from tests.controls.court import convictions, findings, page
from tests.controls.sick import SICK


def main() -> None:
    """Tries every control; progress goes to stderr."""
    rows = []
    for sick in SICK:
        rows.append((sick, convictions(findings(sick.model, sick.values))))
        print(sick.name, ", ".join(rows[-1][1]), file=sys.stderr, flush=True)
    write_whole(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_name("README.md"), page(rows))


if __name__ == "__main__":
    main()
