"""Files are written whole or not at all."""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Mapping
from pathlib import Path


def write_whole(path: Path, content: str | bytes, modified: float | None = None) -> None:
    """Writes to a temporary file beside `path`, then renames it, so that nobody ever sees half a file.

    `modified` is the time, in seconds since 1970, that the file shall bear; now by default.
    Raises OSError where the folder is missing or not writable, or where `path` is a folder.
    """
    write_all({path: content.encode("utf-8") if isinstance(content, str) else content}, modified)


def write_all(contents: Mapping[Path, bytes], modified: float | None = None) -> None:
    """Writes several files, all of them or none: whatever stops it, an interrupt included, leaves what was there before.

    Temporary files beside all of them come first, then each is renamed. While the renames go on, those who look may see new files
    beside old ones. Raises OSError as `write_whole` does.
    """
    for path in contents:
        if path.is_dir():
            raise IsADirectoryError(21, "Is a directory", str(path))
    # named before they are made: an interrupt between making one and noting its name would leave it behind
    staged = {path: _beside(path) for path in contents}
    kept = {path: _beside(path) for path in [*contents][:-1]}  # once the last is renamed there is nothing to take back
    renaming = False
    try:
        for path, data in contents.items():
            _stage(staged[path], data, modified)
        renaming = True
        for path, temporary in staged.items():
            if path in kept and path.exists():
                _keep(path, kept[path])
            os.replace(temporary, path)
    except BaseException:
        left = [path for path, temporary in staged.items() if temporary.exists()]
        if renaming and left:
            for path in kept.keys() - left:
                if kept[path].exists():
                    os.replace(kept[path], path)
                else:
                    path.unlink()
        raise
    finally:
        for temporary in (*staged.values(), *kept.values()):
            temporary.unlink(missing_ok=True)


def try_out(path: Path) -> None:
    """Nothing, if a file can be written there. Raises OSError."""
    if path.exists() and not path.is_file():
        raise IsADirectoryError(21, "a folder or a device", str(path))
    trial = _beside(path)
    try:
        _stage(trial, b"", None)
    finally:
        trial.unlink(missing_ok=True)


def _beside(path: Path) -> Path:
    """A name in the same folder that nobody has."""
    return path.parent / f".{path.name}.{secrets.token_hex(8)}"


def _stage(temporary: Path, data: bytes, modified: float | None) -> None:
    """A new file with the permissions that the user's mask leaves."""
    with os.fdopen(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666), "wb") as stream:
        stream.write(data)
    if modified is not None:
        os.utime(temporary, (modified, modified))


def _keep(path: Path, second: Path) -> None:
    """The file under a second name; copied where the file system has no links."""
    try:
        os.link(path, second)
    except OSError:
        shutil.copy2(path, second)
