"""Files are written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path


def write_whole(path: Path, content: str | bytes, modified: float | None = None) -> None:
    """Writes to a temporary file beside `path`, then renames it, so that nobody ever sees half a file.

    `modified` is the time, in seconds since 1970, that the file shall bear; now by default.
    Raises OSError where the folder is missing or not writable, or where `path` is a folder.
    """
    if path.is_dir():
        raise IsADirectoryError(21, "Is a directory", str(path))
    data = content.encode("utf-8") if isinstance(content, str) else content
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(temporary, 0o666 & ~mask)
        if modified is not None:
            os.utime(temporary, (modified, modified))
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
