# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Files that change while a mesh is shown."""
from __future__ import annotations

import os
import time
from collections.abc import Sequence
from typing import Any

from .files import ReadingError

# Seconds between two looks at the files. A file that changed between two looks is being written.
PERIOD = 1.0


def _sign(name: str) -> tuple[int, int] | None:
    """Time and size of a file; None if there is none."""
    try:
        found = os.stat(name)
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size


class Watch:
    """Reads the files of a MeshScene again when they change."""

    def __init__(self, scene: Any, period: float = PERIOD) -> None:
        """period: seconds for which the files must stay as they are before they are read."""
        self._scene = scene
        self._period = period
        self._seen = self._look()
        self._since = time.monotonic()
        self._is_new = False

    def _look(self) -> Sequence[tuple[int, int] | None]:
        return [_sign(name) for name in self._scene.series.names]

    def reload(self) -> str | None:
        """Reads the files if they have changed, and are not being written. Returns None if nothing
        happened, an empty text after a reload, or the reason why the files cannot be used; then
        the mesh of before stays until they change again."""
        seen = self._look()
        if seen != self._seen:
            self._seen, self._since, self._is_new = seen, time.monotonic(), True
        if (not self._is_new or None in seen
                or time.monotonic() - self._since < self._period):
            return None
        self._is_new = False
        try:
            self._scene.reload()
        except ReadingError as error:
            return f"{error} (it is read again when it changes)"
        return ""
