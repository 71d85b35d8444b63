"""Checks of the options of the built-in optimizers."""

from __future__ import annotations


def require(name: str, value: float, least: float, most: float = float("inf")) -> None:
    """ValueError unless least <= value <= most."""
    if not least <= value <= most:
        limits = f"at least {least}" if most == float("inf") else f"between {least} and {most}"
        raise ValueError(f"{name}: expected {limits}, got {value}")
