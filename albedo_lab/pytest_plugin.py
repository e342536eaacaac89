"""The pytest plugin: a fixture that holds the assertions. pytest imports this file at every start: it imports nothing heavy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from types import ModuleType


@pytest.fixture(scope="session")
def brdf_check() -> ModuleType:
    """The assertions of `albedo_lab.testing`: brdf_check.assert_energy_conserving("ward", m=0.2)."""
    from albedo_lab import testing

    return testing
