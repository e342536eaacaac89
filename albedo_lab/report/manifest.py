"""What the reports were made with, and the digest of every file: whoever makes them again can compare."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Iterable, Mapping
from importlib.metadata import version
from pathlib import Path

from albedo_lab import __version__

LIBRARIES = ("numpy", "scipy", "numba", "pandas", "matplotlib", "jinja2")
NAME = "manifest.json"


def manifest(files: Mapping[str, bytes], seed: int) -> str:
    """Versions, seed and the SHA-256 of each file, as JSON with sorted names."""
    made_with = {"albedo_lab": __version__, "python": platform.python_version(), **{name: version(name) for name in LIBRARIES}}
    record = {"versions": made_with, "seed": seed, "sha256": {name: digest(files[name]) for name in sorted(files)}}
    return json.dumps(record, indent=2) + "\n"


def digest(content: bytes) -> str:
    """SHA-256 in hexadecimal."""
    return hashlib.sha256(content).hexdigest()


def left_over(directory: Path, files: Iterable[str]) -> list[Path]:
    """Files that an earlier run wrote there and this one does not: those of its manifest which nobody has changed since."""
    try:
        before = json.loads((directory / NAME).read_text(encoding="utf-8"))["sha256"]
    except (OSError, ValueError, KeyError):
        return []
    old = {directory / name: of_old for name, of_old in before.items() if name not in set(files)}
    return [path for path, of_old in old.items() if path.is_file() and digest(path.read_bytes()) == of_old]
