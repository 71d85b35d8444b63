"""Where a thing comes from, and what was wrong with a plugin."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Origin:
    """The plugin (name of its entry point) and the distribution that brought a thing."""

    plugin: str
    distribution: str
    version: str

    def __str__(self) -> str:
        return f"{self.plugin} ({self.distribution} {self.version})"


@dataclass(frozen=True)
class PluginFault:
    """Why a plugin, or one of its things, was set aside. ``error`` is what it raised, if it did."""

    origin: Origin
    message: str
    error: BaseException | None = None

    def __str__(self) -> str:
        return f"plugin {self.origin} {self.message}"
