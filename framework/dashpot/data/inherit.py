"""Defaults of a dataset: what a run does not say itself, the defaults say."""

from __future__ import annotations

from dashpot.text.node import Mapping, Node


def inherit(node: Node, defaults: Mapping | None) -> Node:
    """The run's mapping completed by the defaults, level by level; every part keeps its place in the text.

    A run that states its own clock (a time channel or a sampling rate) does not inherit the other one.
    """
    if defaults is None or not isinstance(node, Mapping):
        return node
    return _merge(node, _without_other_clock(node, defaults))


def _merge(own: Mapping, given: Mapping) -> Mapping:
    entries = dict(given.entries)
    for key, node in own.entries.items():
        below = entries.get(key)
        entries[key] = _merge(node, below) if isinstance(node, Mapping) and isinstance(below, Mapping) else node
    return Mapping(own.place, own.start, own.end, entries, {**given.keys, **own.keys})


def _without_other_clock(node: Mapping, defaults: Mapping) -> Mapping:
    channels = node.entries.get("channels")
    inner = channels.entries if isinstance(channels, Mapping) else {}
    if "sampling" in node.entries or "sampling" in inner:
        return _without(defaults, "time")
    return _without(defaults, "sampling") if "time" in inner else defaults


def _without(defaults: Mapping, name: str) -> Mapping:
    channels = defaults.entries.get("channels")
    entries = {key: value for key, value in defaults.entries.items() if key != name}
    if isinstance(channels, Mapping):
        inner = {key: value for key, value in channels.entries.items() if key != name}
        entries["channels"] = Mapping(channels.place, channels.start, channels.end, inner, channels.keys)
    return Mapping(defaults.place, defaults.start, defaults.end, entries, defaults.keys)
